// SPDX-License-Identifier: BSD-3-Clause
// Edges along the path of missions that come without any.
#pragma once
#include "cambium/mission.hpp"

namespace cambium {

/// From `tail` to the next node as their poses say; of independent sigmas [m; rad].
inline Edge odometry_edge(const Node& tail, const Node& head, double sigma_position,
                          double sigma_rotation) {
  Edge edge;
  edge.tail = tail.id;
  edge.head = head.id;
  edge.T_tail_head = tail.T_mission_node.inverse() * head.T_mission_node;
  edge.information.setZero();
  edge.information.diagonal().head<3>().setConstant(1 / (sigma_position * sigma_position));
  edge.information.diagonal().tail<3>().setConstant(1 / (sigma_rotation * sigma_rotation));
  edge.tag = "EDGE_SE3:QUAT";
  return edge;
}

}  // namespace cambium
