// SPDX-License-Identifier: BSD-3-Clause
#include "map_json.hpp"

#include <cmath>
#include <map>

#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"

namespace web_view {
namespace {

using namespace cambium;

constexpr std::size_t most_fixes = 3000;  // of a mission; more would only hide the picture

void append(Json& list, const Vec3& p) {
  for (const double v : p) list.push_back(rounded(v, 3));
}

void append(Json& list, const SE3& T) {
  for (const double v : T.t) list.push_back(rounded(v, 4));
  for (const double v : T.q.coeffs()) list.push_back(rounded(v, 7));
}

Json fixes_json(const Mission& mission, const std::optional<GeoReference>& g, std::size_t step) {
  Json out = Json::array();
  for (std::size_t i = 0; g && i < mission.fixes.size(); i += step) {
    const GnssFix& f = mission.fixes[i];
    append(out, g->T_map_enu * to_enu({g->latitude, g->longitude, g->altitude},
                                      {f.latitude, f.longitude, f.altitude}));
  }
  return out;
}

Json odometry_json(const Atlas& atlas) {
  Json out = Json::array();
  for (const MissionState& state : atlas.missions)
    for (const Node& node : state.mission->nodes)
      append(out, T_map_mission(state) * node.T_mission_node);
  return out;
}

/// What an optimisation left, in the frame of the map: islands that had a frame of their own are
/// placed by the first node of their first mission.
Json poses_json(const Atlas& atlas, const Stage& stage) {
  std::map<std::uint32_t, SE3> T_map_stage;  // by the island of that time
  for (std::size_t m = 0; m < stage.T_map_node.size(); ++m)
    if (!stage.T_map_node[m]->empty())
      T_map_stage.emplace(stage.islands[m], atlas.missions[m].T_map_node->front() *
                                                stage.T_map_node[m]->front().inverse());
  Json out = Json::array();
  for (std::size_t m = 0; m < stage.T_map_node.size(); ++m)
    for (const SE3& T : *stage.T_map_node[m]) append(out, T_map_stage.at(stage.islands[m]) * T);
  return out;
}

/// The poses of the map as a last stage.
Stage map_stage(const Atlas& atlas) {
  Stage out;
  out.step = "map";
  for (const MissionState& state : atlas.missions) {
    out.T_map_node.push_back(state.T_map_node);
    out.islands.push_back(state.island);
  }
  return out;
}

}  // namespace

Json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale + 0.0;  // no -0
}

std::vector<std::uint32_t> first_nodes(const Atlas& atlas) {
  std::vector<std::uint32_t> out;
  std::uint32_t next = 0;
  for (const MissionState& state : atlas.missions) {
    out.push_back(next);
    next += std::uint32_t(state.mission->nodes.size());
  }
  return out;
}

Json missions_json(const Atlas& atlas) {
  Json out = Json::array();
  for (const MissionState& state : atlas.missions) {
    const Mission& m = *state.mission;
    Json ids = Json::array();
    for (const Node& node : m.nodes) ids.push_back(node.id);
    const auto walked = travelled(m);
    const std::size_t step = m.fixes.size() / most_fixes + 1;
    out.push_back({{"name", m.name},
                   {"platform", m.platform_id},
                   {"island", state.island},
                   {"length", rounded(walked.empty() ? 0 : walked.back(), 1)},
                   {"ids", std::move(ids)},
                   {"fix_count", m.fixes.size()},
                   {"fix_step", step},
                   {"fixes", fixes_json(m, georeference(atlas, atlas.islands.at(state.island)), step)}});
  }
  return out;
}

Json stages_json(const Atlas& atlas) {
  Json out = Json::array({{{"name", "odometry"}, {"poses", odometry_json(atlas)}}});
  const Stage map = map_stage(atlas);
  for (const Stage& stage : atlas.stages)
    if (&stage != &atlas.stages.back() || stage.T_map_node != map.T_map_node)  // the map itself
      out.push_back({{"name", stage.step}, {"poses", poses_json(atlas, stage)}});
  out.push_back({{"name", map.step}, {"poses", poses_json(atlas, map)}});
  return out;
}

Json stems_json(const std::vector<Stem>& stems, std::size_t island) {
  Json out = Json::array();
  for (const Stem& s : stems) {
    Json base = Json::array(), axis = Json::array();
    append(base, s.base);
    for (const double v : s.axis) axis.push_back(rounded(v, 4));
    out.push_back({{"island", island},
                   {"base", std::move(base)},
                   {"axis", std::move(axis)},
                   {"dbh", rounded(s.dbh, 4)},
                   {"dbh_spread", rounded(s.dbh_spread, 4)},
                   {"sightings", s.seen_by.size()},
                   {"missions", s.missions()}});
  }
  return out;
}

Json tiles_json(const TileTree& tree, const std::string& folder) {
  Json low = Json::array(), tiles = Json::object();
  for (const auto v : tree.root.low) low.push_back(double(v) / units_per_metre);
  for (const auto& [name, points] : tree.tiles) tiles[name] = points;
  return {{"folder", folder},
          {"low", std::move(low)},
          {"width", std::ldexp(1.0, tree.root.bits) / units_per_metre},
          {"unit", 1 / units_per_metre},
          {"points", tree.points},
          {"tiles", std::move(tiles)}};
}

}  // namespace web_view
