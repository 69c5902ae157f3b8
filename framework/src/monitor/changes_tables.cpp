// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "cambium/fused.hpp"
#include "monitor/changes_output.hpp"

namespace cambium::monitor {
namespace {

std::optional<GeoReference> reference(const Survey& before) {
  return georeference(before.clouds, before.clouds.islands[island_of(before)]);
}

Json cell_row(const CellChange& c, double cell_size, const std::optional<GeoReference>& g) {
  Json row;
  add_place(row, {(c.cell[0] + 0.5) * cell_size, (c.cell[1] + 0.5) * cell_size, 0}, g);
  row.erase("z");
  row.erase("altitude");
  row["ground"] = c.ground ? rounded(*c.ground, 3) : Json();
  row["canopy"] = c.canopy ? rounded(*c.canopy, 2) : Json();
  return row;
}

std::string csv_line(const Json& row, bool names) {
  std::string out;
  bool first = true;
  for (const auto& [name, value] : row.items()) {
    if (!first) out += ',';
    first = false;
    if (names)
      out += name;
    else if (value.is_string() && value.get<std::string>().find(',') != std::string::npos)
      out += '"' + value.get<std::string>() + '"';
    else if (value.is_string())
      out += value.get<std::string>();
    else if (!value.is_null())
      out += value.dump();
  }
  return out + '\n';
}

template <class Rows, class Row>
std::string csv(const Rows& rows, Row row_of) {
  std::string out;
  for (const auto& item : rows) {
    const Json row = row_of(item);
    if (out.empty()) out = csv_line(row, true);
    out += csv_line(row, false);
  }
  return out;
}

}  // namespace

Json stem_row(const StemChange& c, const std::optional<GeoReference>& g) {
  Json row;
  row["change"] = to_string(c.change);
  add_place(row, c.base, g);
  const auto side = [&](const char* when, const std::optional<Stem>& stem) {
    const std::string w = when;
    row["dbh_" + w] = stem ? rounded(stem->dbh, 4) : Json();
    row["sigma_" + w] = stem ? rounded(stem->dbh_sigma, 4) : Json();
    row["sightings_" + w] = stem ? Json(stem->seen_by.size()) : Json();
  };
  side("before", c.before);
  side("after", c.after);
  const bool both = c.change == Change::kept;
  row["growth"] = both ? rounded(c.growth, 4) : Json();
  row["growth_sigma"] = both ? rounded(c.growth_sigma, 4) : Json();
  row["expected"] = both ? Json() : rounded(c.expected, 1);
  row["near"] = both ? Json() : Json(c.near);
  row["reason"] = c.reason;
  return row;
}

std::string stems_csv(const Survey& before, const Changes& changes) {
  const auto g = reference(before);
  return csv(changes.stems, [&](const StemChange& c) { return stem_row(c, g); });
}

std::string cells_csv(const Survey& before, const Changes& changes, double cell_size) {
  const auto g = reference(before);
  return csv(changes.cells, [&](const CellChange& c) { return cell_row(c, cell_size, g); });
}

std::optional<std::string> stems_geojson(const Survey& before, const Changes& changes) {
  const auto g = reference(before);
  if (!g) return std::nullopt;
  Json features = Json::array();
  for (const StemChange& c : changes.stems)
    features.push_back(point_feature(*g, c.base, stem_row(c, g)));
  return feature_collection(std::move(features));
}

std::optional<std::string> cells_geojson(const Survey& before, const Changes& changes,
                                         double cell_size) {
  const auto g = reference(before);
  if (!g) return std::nullopt;
  Json features = Json::array();
  constexpr std::array<std::array<int, 2>, 5> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  for (const CellChange& c : changes.cells) {
    Json ring = Json::array();
    for (const auto& corner : corners)
      ring.push_back(position(
          *g, {(c.cell[0] + corner[0]) * cell_size, (c.cell[1] + corner[1]) * cell_size, 0}));
    for (Json& p : ring) p.erase(2);  // a cell has no height of its own
    Json feature;
    feature["type"] = "Feature";
    feature["properties"] = {{"ground", c.ground ? rounded(*c.ground, 3) : Json()},
                             {"canopy", c.canopy ? rounded(*c.canopy, 2) : Json()}};
    feature["geometry"] = {{"type", "Polygon"}, {"coordinates", Json::array({ring})}};
    features.push_back(feature);
  }
  return feature_collection(std::move(features));
}

}  // namespace cambium::monitor
