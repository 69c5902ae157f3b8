// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cambium/error.hpp"
#include "monitor/place.hpp"

namespace cambium::monitor {
namespace {

using Json = nlohmann::json;

[[noreturn]] void refuse(const std::string& where, const std::string& what) {
  throw Error(ErrorCode::data, where, what);
}

void add_polygon(const Json& rings, const std::string& where, std::vector<std::vector<Vec3>>& out) {
  for (const Json& corners : rings) {
    std::vector<Vec3> ring;
    for (const Json& c : corners) ring.push_back({c.at(0).get<double>(), c.at(1).get<double>(), 0});
    if (ring.size() < 4 || ring.front() != ring.back())
      refuse(where, fmt::format("a ring of a polygon has {} positions, expected 4 or more of which "
                                "the last repeats the first (RFC 7946)",
                                ring.size()));
    ring.pop_back();
    out.push_back(std::move(ring));
  }
}

void add_polygons(const Json& json, const std::string& where, std::vector<std::vector<Vec3>>& out) {
  const std::string type = json.at("type").get<std::string>();
  if (type == "FeatureCollection")
    for (const Json& feature : json.at("features")) add_polygons(feature, where, out);
  else if (type == "Feature")
    add_polygons(json.at("geometry"), where, out);
  else if (type == "GeometryCollection")
    for (const Json& geometry : json.at("geometries")) add_polygons(geometry, where, out);
  else if (type == "Polygon")
    add_polygon(json.at("coordinates"), where, out);
  else if (type == "MultiPolygon")
    for (const Json& polygon : json.at("coordinates")) add_polygon(polygon, where, out);
  else
    refuse(where, fmt::format("found a {}, expected a Polygon or MultiPolygon", type));
}

}  // namespace

std::vector<std::vector<Vec3>> geojson_rings(const std::string& text, const std::string& where) {
  std::vector<std::vector<Vec3>> out;
  try {
    add_polygons(Json::parse(text), where, out);
  } catch (const Json::exception& e) {
    refuse(where, fmt::format("is no GeoJSON with polygons: {}", e.what()));
  }
  if (out.empty()) refuse(where, "holds no polygon");
  return out;
}

}  // namespace cambium::monitor
