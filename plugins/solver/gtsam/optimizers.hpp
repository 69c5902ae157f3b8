// SPDX-License-Identifier: BSD-3-Clause
// The two ways of GTSAM to a minimum. Both return the start with a message where GTSAM gives up.
#pragma once
#include "common/minimizer.hpp"
#include "factor_graph.hpp"

namespace cambium::gtsam_solver {

/// Levenberg-Marquardt over the whole graph at once.
pose_solver::Minimum batch(const FactorGraph& graph, const std::vector<SE3>& start,
                           const pose_solver::Limits& limits, const Context& context);

/// iSAM2 (M. Kaess, H. Johannsson, R. Roberts, V. Ila, J. Leonard, F. Dellaert, IJRR 31(2), 2012):
/// the nodes come in the order of the graph, `at_once` of them an update, each factor with its last
/// node; then updates without news until the cost rests.
pose_solver::Minimum isam2(const FactorGraph& graph, const std::vector<SE3>& start, int at_once,
                           const pose_solver::Limits& limits, const Context& context);

}  // namespace cambium::gtsam_solver
