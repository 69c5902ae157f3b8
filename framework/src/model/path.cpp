// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/path.hpp"

namespace cambium {

std::vector<double> travelled(const Mission& mission) {
  const auto& nodes = mission.nodes;
  std::vector<double> path(nodes.size(), 0.0);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    path[i] = path[i - 1] + (nodes[i].T_mission_node.t - nodes[i - 1].T_mission_node.t).norm();
  return path;
}

}  // namespace cambium
