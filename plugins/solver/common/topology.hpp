// SPDX-License-Identifier: BSD-3-Clause
// What in the structure of a graph is probably not meant.
#pragma once
#include <vector>

#include "cambium/context.hpp"
#include "cambium/pose_graph.hpp"

namespace cambium::pose_solver {

/// Warns, naming factors and nodes, of relative factors that are copies of others (both count) and
/// of parts of the graph that nothing ties to the map (each stays where its first node is).
void warn_of_topology(const PoseGraph& graph, const std::vector<std::size_t>& component,
                      const std::vector<bool>& held, const Context& context);

}  // namespace cambium::pose_solver
