// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "cambium/fused.hpp"
#include "cambium/string_table.hpp"
#include "report/page.hpp"

namespace cambium {
namespace {

/// How far a registered transform is from where two poses put the nodes: [m; deg].
std::pair<double, double> difference(const Loop& loop, const SE3& T_map_tail,
                                     const SE3& T_map_head) {
  const SE3 error = loop.T_tail_head.inverse() * (T_map_tail.inverse() * T_map_head);
  const double angle = 2 * std::atan2(error.q.vec().norm(), std::abs(error.q.w()));
  return {significant(error.t.norm(), 4), significant(angle * 180 / std::numbers::pi, 4)};
}

/// Where the odometry alone puts a node, with its mission placed as a whole.
SE3 by_odometry(const Atlas& atlas, const std::vector<SE3>& T_map_missions, NodeRef n) {
  return T_map_missions[n.mission] * atlas.node(n).T_mission_node;
}

void add_differences(Json& out, const Atlas& atlas, const std::vector<SE3>& T_map_missions,
                     const Loop& loop) {
  const bool one_frame =
      atlas.missions[loop.tail.mission].island == atlas.missions[loop.head.mission].island;
  if (!has_transform(loop) || !one_frame) {
    for (const char* name : {"before_m", "before_deg", "after_m", "after_deg"})
      out[name].push_back(nullptr);
    return;
  }
  const auto before = difference(loop, by_odometry(atlas, T_map_missions, loop.tail),
                                 by_odometry(atlas, T_map_missions, loop.head));
  const auto after = difference(loop, atlas.T_map_node(loop.tail), atlas.T_map_node(loop.head));
  out["before_m"].push_back(before.first);
  out["before_deg"].push_back(before.second);
  out["after_m"].push_back(after.first);
  out["after_deg"].push_back(after.second);
}

void add_row(Json& out, StringTable& strings, const Loop& loop) {
  out["tail_mission"].push_back(loop.tail.mission);
  out["tail"].push_back(loop.tail.node);
  out["head_mission"].push_back(loop.head.mission);
  out["head"].push_back(loop.head.node);
  out["state"].push_back(strings(to_string(loop.state)));
  out["proposed_by"].push_back(strings(loop.proposed_by));
  out["registered_by"].push_back(strings(loop.registered_by));
  out["decided_by"].push_back(strings(loop.decided_by));
  out["reason"].push_back(strings(loop.reason));
  out["weight"].push_back(loop.state == LoopState::accepted ? Json(significant(loop.weight, 3))
                                                            : Json(nullptr));
  // A score is a pair of numbers: that of its name, and its value.
  Json scores = Json::array();
  for (const auto& [name, value] : loop.scores) {
    scores.push_back(strings(name));
    scores.push_back(significant(value, 4));
  }
  out["scores"].push_back(std::move(scores));
}

}  // namespace

Json page_ledger(const Atlas& atlas) {
  Json out = Json::object();
  for (const char* name : {"tail_mission", "tail", "head_mission", "head", "state", "proposed_by",
                           "registered_by", "decided_by", "reason", "weight", "scores", "before_m",
                           "before_deg", "after_m", "after_deg"})
    out[name] = Json::array();
  std::vector<SE3> T_map_missions;
  for (const MissionState& state : atlas.missions) T_map_missions.push_back(T_map_mission(state));
  StringTable strings;
  for (const Loop& loop : atlas.loops) {
    add_row(out, strings, loop);
    add_differences(out, atlas, T_map_missions, loop);
  }
  out["strings"] = strings.list();
  return out;
}

}  // namespace cambium
