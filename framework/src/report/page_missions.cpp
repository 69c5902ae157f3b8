// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"
#include "report/page.hpp"

namespace cambium {
namespace {

constexpr std::size_t most_fixes = 3000;  // of a mission; more would only blacken the picture

void append(Json& list, const Vec3& p) {
  for (const double v : p) list.push_back(std::round(1000 * v) / 1000);
}

/// x y z x y z ..., as the robot estimated it or as optimised.
Json path(const MissionState& state, bool odometry) {
  Json out = Json::array();
  const SE3 T = T_map_mission(state);
  for (std::size_t i = 0; i < state.T_map_node->size(); ++i)
    append(out, odometry ? T * state.mission->nodes[i].T_mission_node.t : (*state.T_map_node)[i].t);
  return out;
}

Json fixes(const MissionState& state, const GeoReference& g, std::size_t step) {
  Json out = Json::array();
  for (std::size_t i = 0; i < state.mission->fixes.size(); i += step) {
    const GnssFix& f = state.mission->fixes[i];
    append(out, g.T_map_enu * to_enu({g.latitude, g.longitude, g.altitude},
                                     {f.latitude, f.longitude, f.altitude}));
  }
  return out;
}

Json ids(const Mission& mission) {
  Json out = Json::array();
  for (const Node& node : mission.nodes) out.push_back(node.id);
  return out;
}

}  // namespace

double significant(double value, int digits) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(value))));
  return std::isfinite(scale) ? std::round(value * scale) / scale : value;
}

Json page_missions(const Atlas& atlas) {
  Json out = Json::array();
  for (const MissionState& state : atlas.missions) {
    const Mission& m = *state.mission;
    const auto walked = travelled(m);
    const std::size_t step =
        std::max<std::size_t>(1, (m.fixes.size() + most_fixes - 1) / most_fixes);
    const auto g = georeference(atlas, atlas.islands.at(state.island));
    out.push_back({{"name", m.name},
                   {"folder", m.folder.string()},
                   {"platform", m.platform_id},
                   {"island", state.island},
                   {"length", significant(walked.empty() ? 0 : walked.back(), 5)},
                   {"fix_count", m.fixes.size()},
                   {"fix_step", step},
                   {"ids", ids(m)},
                   {"odometry", path(state, true)},
                   {"path", path(state, false)},
                   {"fixes", g ? fixes(state, *g, step) : Json::array()}});
  }
  return out;
}

}  // namespace cambium
