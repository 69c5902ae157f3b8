// SPDX-License-Identifier: BSD-3-Clause
// Pose graphs for solver tests and benchmarks.
#pragma once
#include "cambium/pose_graph.hpp"

namespace cambium::testing {

/// One mission in its own frame: loops are robust, FIX lines are fixed, else the first node is.
PoseGraph pose_graph_from(const Mission& mission);

}  // namespace cambium::testing
