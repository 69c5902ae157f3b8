// SPDX-License-Identifier: BSD-3-Clause
// Chordal relaxation: poses from a pose graph without an initial estimate. L. Carlone, R. Tron,
// K. Daniilidis, F. Dellaert, "Initialization techniques for 3D SLAM: a survey on rotation
// estimation and its use in pose graph optimization", ICRA 2015, section III-B.
#pragma once
#include <vector>

#include "common/elimination.hpp"

namespace cambium::pose_solver {

/// The rotations that minimise sum omega |R_head - R_tail R_tail_head|_F^2 over all 3x3 matrices,
/// each projected to SO(3), then the translations that minimise sum tau |t_head - t_tail - R_tail
/// t_tail_head|^2, over the relative factors k with use[k]. omega and tau are the mean eigenvalues
/// of the information's rotation and translation block.
///
/// Nodes without a place in `elimination` keep their pose of the graph. Over the used factors every
/// node must be connected to one. Empty when a linear system could not be solved.
std::vector<SE3> chordal_poses(const PoseGraph& graph, const Elimination& elimination,
                               const std::vector<bool>& use);

}  // namespace cambium::pose_solver
