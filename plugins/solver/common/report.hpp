// SPDX-License-Identifier: BSD-3-Clause
// What is said of a solution beyond its poses.
#pragma once
#include "cambium/context.hpp"
#include "common/calibration.hpp"
#include "common/loss.hpp"
#include "common/problem.hpp"
#include "common/weights.hpp"

namespace cambium::pose_solver {

/// Of every relative factor: how much of it counted, 0..1.
std::vector<double> final_weights(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                                  const Weights& weights, const Loss& loss);

/// Adds "gradient_norm" and "condition" when asked for, and the marginal covariances of
/// PoseGraph::marginals. Throws Error(numeric) when a marginal does not exist.
void report_equations(const Problem& problem, const Weights& weights, const Loss& loss,
                      bool diagnostics, Solution& solution);

/// Adds "odometry.<first node>.translation" and ".rotation": by how much the sigmas of a mission's
/// odometry were scaled; warns where too few loops tell.
void report_odometry(const std::vector<OdometryGroup>& groups, const PoseGraph& graph,
                     const Context& context, Solution& solution);

/// Adds "certified" and "certificate.smallest_eigenvalue"; warns when the proof fails or is not
/// applicable.
void report_certificate(const PoseGraph& graph, const Weights& weights, const Loss& loss,
                        const Context& context, Solution& solution);

}  // namespace cambium::pose_solver
