// SPDX-License-Identifier: BSD-3-Clause
#include "support/pose_graph.hpp"

#include <algorithm>

namespace cambium::testing {

PoseGraph pose_graph_from(const Mission& mission) {
  PoseGraph g;
  for (const Node& node : mission.nodes) {
    g.T_map_node.push_back(node.T_mission_node);
    g.ids.push_back(node.id);
    g.fixed.push_back(node.fixed);
  }
  if (!g.fixed.empty() && std::count(g.fixed.begin(), g.fixed.end(), true) == 0) g.fixed[0] = true;
  for (const Edge& e : mission.edges) {
    const std::size_t tail = mission.index_of(e.tail).value();
    const std::size_t head = mission.index_of(e.head).value();
    const std::string label = mission.graph_file.string() + ":" + std::to_string(e.line);
    if (e.kind == EdgeKind::prior)
      g.priors.push_back({head, e.T_tail_head, e.information, label});
    else if (e.kind == EdgeKind::position)
      g.positions.push_back(
          {head, e.T_tail_head.t, e.information.topLeftCorner<3, 3>(), true, label});
    else
      g.relative.push_back(
          {tail, head, e.T_tail_head, e.information, e.kind == EdgeKind::loop, label});
  }
  return g;
}

}  // namespace cambium::testing
