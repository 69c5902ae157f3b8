// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>

#include "cambium/fused.hpp"
#include "monitor/json.hpp"
#include "monitor/query.hpp"

namespace cambium::monitor {
namespace {

struct MissionShare {
  std::size_t inside = 0, seeing = 0, points = 0;
  std::optional<Stamp> first, last;
};

std::map<std::uint32_t, MissionShare> by_mission(const Survey& survey, const QueryResult& result) {
  std::map<std::uint32_t, MissionShare> out;
  for (const SeenNode& s : result.nodes) {
    MissionShare& share = out[s.node.mission];
    share.inside += s.inside;
    share.seeing += s.points > 0;
    share.points += s.points;
    const auto& stamp = survey.clouds.node(s.node).stamp;
    if (!stamp) continue;
    if (!share.first || *stamp < *share.first) share.first = stamp;
    if (!share.last || *stamp > *share.last) share.last = stamp;
  }
  return out;
}

Json missions_json(const Survey& survey, const QueryResult& result) {
  Json out = Json::array();
  for (const auto& [m, share] : by_mission(survey, result)) {
    const MissionState& state = survey.clouds.missions[m];
    Json& row = out.emplace_back();
    row["name"] = state.mission->name;
    row["platform"] = state.mission->platform_id;
    row["island"] = state.island;
    row["first"] = share.first ? Json(share.first->seconds()) : Json();
    row["last"] = share.last ? Json(share.last->seconds()) : Json();
    row["nodes_inside"] = share.inside;
    row["nodes_seeing"] = share.seeing;
    row["points"] = share.points;
  }
  return out;
}

Json node_json(const Survey& survey, const SeenNode& s) {
  const Node& node = survey.clouds.node(s.node);
  const Vec3& p = survey.clouds.T_map_node(s.node).t;
  Json row;
  row["mission"] = survey.clouds.mission(s.node).name;
  row["id"] = node.id;
  if (node.stamp) row["sec"] = node.stamp->sec, row["nsec"] = node.stamp->nsec;
  add_place(row, p, island_reference(survey, survey.clouds.missions[s.node.mission].island));
  row["inside"] = s.inside;
  row["points"] = s.points;
  return row;
}

Json stem_json(const Survey& survey, const SeenStem& s) {
  Json row;
  row["island"] = s.island;
  add_place(row, s.stem.base, island_reference(survey, s.island));
  row["dbh"] = rounded(s.stem.dbh, 4);
  row["dbh_spread"] = rounded(s.stem.dbh_spread, 4);
  row["dbh_sigma"] = rounded(s.stem.dbh_sigma, 4);
  row["score"] = rounded(s.stem.score, 3);
  row["sightings"] = s.stem.seen_by.size();
  row["missions"] = mission_names(survey.clouds, s.stem);
  return row;
}

}  // namespace

Json query_json(const Survey& survey, const QueryResult& result) {
  Json out;
  out["map"] = survey.name;
  out["missions"] = missions_json(survey, result);
  out["nodes"] = Json::array();
  for (const SeenNode& s : result.nodes) out["nodes"].push_back(node_json(survey, s));
  out["stems"] = Json::array();
  for (const SeenStem& s : result.stems) out["stems"].push_back(stem_json(survey, s));
  return out;
}

std::string query_stems_geojson(const Survey& survey, const QueryResult& result) {
  Json features = Json::array();
  for (const SeenStem& s : result.stems) {
    const Json row = stem_json(survey, s);
    features.push_back(point_feature(island_reference(survey, s.island), s.stem.base, row));
  }
  return feature_collection(std::move(features));
}

std::string query_text(const Survey& survey, const QueryResult& result) {
  std::string out;
  const auto line = std::back_inserter(out);
  const auto missions = by_mission(survey, result);
  std::size_t width = 7;
  for (const auto& [m, share] : missions)
    width = std::max(width, survey.clouds.missions[m].mission->name.size());
  fmt::format_to(line, "{:<{}}  {:>6}  {:>6}  {:>10}  {:>15}  {:>15}\n", "mission", width, "inside",
                 "seeing", "points", "first [s]", "last [s]");
  for (const auto& [m, share] : missions)
    fmt::format_to(line, "{:<{}}  {:>6}  {:>6}  {:>10}  {:>15}  {:>15}\n",
                   survey.clouds.missions[m].mission->name, width, share.inside, share.seeing,
                   share.points, share.first ? fmt::format("{:.3f}", share.first->seconds()) : "-",
                   share.last ? fmt::format("{:.3f}", share.last->seconds()) : "-");
  if (!survey.has_trees)
    return out + "no node has a tree table, so no stems; see the filter stem_extraction\n";
  fmt::format_to(line, "\n{} stems\n", result.stems.size());
  if (result.stems.empty()) return out;
  fmt::format_to(line, "{:>12}  {:>13}  {:>7}  {:>7}  {:>9}  {}\n", "latitude", "longitude",
                 "dbh [m]", "+-", "sightings", "missions");
  for (const SeenStem& s : result.stems) {
    const Json row = stem_json(survey, s);
    fmt::format_to(line, "{:>12.7f}  {:>13.7f}  {:>7.3f}  {:>7.3f}  {:>9}  {}\n",
                   row["latitude"].get<double>(), row["longitude"].get<double>(), s.stem.dbh,
                   s.stem.dbh_sigma, s.stem.seen_by.size(), row["missions"].get<std::string>());
  }
  return out;
}

}  // namespace cambium::monitor
