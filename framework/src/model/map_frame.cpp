// SPDX-License-Identifier: BSD-3-Clause
// Where missions, their trajectories and the globe are in the map frame.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "cambium/fused.hpp"
#include "model/own_frame.hpp"

namespace cambium {

SE3 T_map_mission(const MissionState& state) {
  if (state.mission->nodes.empty()) return {};
  return state.T_map_node->front() * state.mission->nodes.front().T_mission_node.inverse();
}

bool gives_map_frame(const MissionState& state, const Island& island, const Atlas& atlas) {
  if (&state != &atlas.missions[island.missions.front()]) return false;
  if (island.missions.size() == 1) return true;
  // Relaxation leans a first node by less, a frame that gravity contradicts lies by more off.
  constexpr double max_tilt = 5 * std::numbers::pi / 180;
  return (T_map_mission(state).q * Vec3(Vec3::UnitZ())).z() > std::cos(max_tilt);
}

std::optional<GeoReference> georeference(const Atlas& atlas, const Island& island) {
  if (island.georeference) return island.georeference;
  for (const std::uint32_t m : island.missions) {
    const MissionState& state = atlas.missions[m];
    if (!state.mission->georeference) continue;
    GeoReference carried = *state.mission->georeference;
    carried.T_map_enu = T_map_mission(state) * carried.T_map_enu;
    return carried;
  }
  return std::nullopt;
}

std::vector<StampedPose> trajectory(const MissionState& state) {
  std::vector<StampedPose> poses;
  for (std::size_t i = 0; i < state.mission->nodes.size(); ++i) {
    const Node& node = state.mission->nodes[i];
    if (node.stamp) poses.push_back({*node.stamp, (*state.T_map_node)[i]});
  }
  return poses;
}

std::string island_file(const std::string& stem, std::size_t island, const std::string& extension) {
  return island == 0 ? stem + extension : fmt::format("{}_island_{}{}", stem, island, extension);
}

}  // namespace cambium
