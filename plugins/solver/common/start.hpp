// SPDX-License-Identifier: BSD-3-Clause
// Where the minimisation starts. A pose graph has many local minima; the start decides which.
#pragma once
#include <vector>

#include "cambium/pose_graph.hpp"
#include "common/loss.hpp"

namespace cambium::pose_solver {

/// For every component the cheapest of: the given poses, the chordal relaxation of all factors, and
/// (under a robust loss) that of the trusted factors with only as many loops as tie them together,
/// which false loops cannot bend.
std::vector<SE3> chordal_start(const PoseGraph& graph, const std::vector<std::size_t>& component,
                               const std::vector<bool>& held, const Loss& loss);

}  // namespace cambium::pose_solver
