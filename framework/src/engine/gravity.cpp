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

struct Party {
  std::size_t leader = 0;  ///< into Island::missions
  Vec3 up = Vec3::UnitZ();
  bool all = false, majority = false;
};

/// The vertical that the largest party shares.
Party largest_party(const Atlas& atlas, const Island& island, const std::vector<Vec3>& up,
                    double limit) {
  Party party;
  std::size_t support = 0, total = 0;
  for (std::size_t i = 0; i < up.size(); ++i) {
    std::size_t nodes = 0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t j = 0; j < up.size(); ++j) {
      if (angle(up[i], up[j]) > limit) continue;
      const std::size_t weight = atlas.missions[island.missions[j]].T_map_node->size();
      nodes += weight;
      sum += double(weight) * up[j];
    }
    if (nodes > support) party.leader = i, party.up = sum.normalized(), support = nodes;
    total += atlas.missions[island.missions[i]].T_map_node->size();
  }
  party.all = support == total;
  party.majority = 2 * support > total;
  return party;
}

/// Everything that has a place in the island's map frame.
void move_island(Atlas& atlas, std::uint32_t island, const SE3& T_new_old) {
  Island& moved = atlas.islands[island];
  for (const std::uint32_t m : moved.missions) {
    auto poses = *atlas.missions[m].T_map_node;
    for (SE3& T : poses) T = T_new_old * T;
    atlas.missions[m].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  }
  if (moved.georeference) moved.georeference->T_map_enu = T_new_old * moved.georeference->T_map_enu;
  const Mat3 R = T_new_old.rotation();
  for (NodePosition& p : moved.positions) {
    p.t_map = T_new_old * p.t_map;
    p.information = R * p.information * R.transpose();
  }
}

void make_level(Atlas& atlas, std::uint32_t island, const Vec3& up) {
  const Vec3 pivot = atlas.missions[atlas.islands[island].missions.front()].T_map_node->front().t;
  SE3 turn;
  turn.q = Quat::FromTwoVectors(up, Vec3(Vec3::UnitZ()));
  turn.t = pivot - turn.q * pivot;
  move_island(atlas, island, turn);
}

}  // namespace

std::set<std::uint32_t> not_level(Atlas& atlas, std::uint32_t island, double limit,
                                  const std::function<void(const std::string&)>& warn) {
  const std::vector<std::uint32_t> missions = atlas.islands[island].missions;
  std::vector<Vec3> up;
  for (const std::uint32_t m : missions) up.push_back(vertical(atlas.missions[m]));
  const Party party = largest_party(atlas, atlas.islands[island], up, limit);
  std::set<std::uint32_t> out;
  if (party.all) return out;
  for (std::size_t i = 0; i < up.size(); ++i) {
    const double off = angle(up[party.leader], up[i]);
    if (party.majority && off <= limit) continue;
    out.insert(missions[i]);
    const std::string& name = atlas.missions[missions[i]].mission->name;
    warn(party.majority
             ? fmt::format("mission '{}' is not level: its vertical is {:.1f} deg off that of the "
                           "missions it is tied to; is its frame z up, and its gravity right? Its "
                           "roll and pitch are not used",
                           name, off / degree)
             : fmt::format("mission '{}' and those it is tied to do not agree on the vertical "
                           "({:.1f} deg), and no majority tells which is wrong; roll and pitch of "
                           "none of them are used",
                           name, off / degree));
  }
  if (party.majority && out.contains(missions.front()) && angle(party.up, Vec3::UnitZ()) > limit)
    make_level(atlas, island, party.up);
  return out;
}

}  // namespace cambium
