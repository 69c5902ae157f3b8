// SPDX-License-Identifier: BSD-3-Clause
#include "engine/gravity.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cambium {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The z axis of the mission's own frame, in the map.
Vec3 vertical(const MissionState& state) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < state.T_map_node->size(); ++i)
    sum += (*state.T_map_node)[i].q *
           (state.mission->nodes[i].T_mission_node.q.conjugate() * Vec3::UnitZ());
  return sum.norm() > 0 ? Vec3(sum.normalized()) : Vec3(Vec3::UnitZ());
}

double angle(const Vec3& a, const Vec3& b) {
  const Vec3 across = a.cross(b);
  return std::atan2(across.norm(), a.dot(b));
}

}  // namespace

std::set<std::uint32_t> not_level(const Atlas& atlas, const Island& island, double limit,
                                  const std::function<void(const std::string&)>& warn) {
  std::vector<Vec3> up;
  std::vector<std::size_t> weight;
  std::size_t total = 0;
  for (const std::uint32_t m : island.missions) {
    up.push_back(vertical(atlas.missions[m]));
    weight.push_back(atlas.missions[m].T_map_node->size());
    total += weight.back();
  }
  // The vertical that the largest party shares.
  std::size_t leader = 0, support = 0;
  for (std::size_t i = 0; i < up.size(); ++i) {
    std::size_t party = 0;
    for (std::size_t j = 0; j < up.size(); ++j)
      if (angle(up[i], up[j]) <= limit) party += weight[j];
    if (party > support) leader = i, support = party;
  }
  std::set<std::uint32_t> out;
  if (support == total) return out;
  const bool majority = 2 * support > total;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double off = angle(up[leader], up[i]);
    if (majority && off <= limit) continue;
    out.insert(island.missions[i]);
    const std::string& name = atlas.missions[island.missions[i]].mission->name;
    warn(majority
             ? fmt::format("mission '{}' is not level: its vertical is {:.1f} deg off that of the "
                           "missions it is tied to; is its frame z up, and its gravity right? Its "
                           "roll and pitch are not used",
                           name, off / degree)
             : fmt::format("mission '{}' and those it is tied to do not agree on the vertical "
                           "({:.1f} deg), and no majority tells which is wrong; roll and pitch of "
                           "none of them are used",
                           name, off / degree));
  }
  return out;
}

}  // namespace cambium
