// SPDX-License-Identifier: BSD-3-Clause
// What must hold before numbers go to a minimiser, which aborts or stalls where this explains.
#pragma once
#include <vector>

#include "cambium/context.hpp"
#include "cambium/pose_graph.hpp"

namespace cambium::pose_solver {

/// The graph with every information matrix symmetric and positive semi-definite; warns, naming the
/// factor, where one was not. Throws Error(numeric) naming the node or factor that is not finite or
/// points outside the graph.
PoseGraph checked(const PoseGraph& graph, const Context& context);

/// The nodes that stay where they are: the fixed ones, and the first node of every component that
/// has neither a fixed node nor an absolute factor (prior, position, attitude) to hold it.
std::vector<bool> held_nodes(const PoseGraph& graph, const std::vector<std::size_t>& component);

}  // namespace cambium::pose_solver
