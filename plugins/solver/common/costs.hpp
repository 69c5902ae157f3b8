// SPDX-License-Identifier: BSD-3-Clause
// What a minimiser lowers: the sum of weight * rho(r' Omega r) over all factors.
#pragma once
#include "common/loss.hpp"
#include "common/weights.hpp"

namespace cambium::pose_solver {

double robust_cost(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                   const Weights& weights, const Loss& loss);

/// The same where the factors of a switchable loss have these switches, not their best ones.
double switched_cost(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                     const Weights& weights, const Loss& loss, const Weights& switches);

/// By connected component.
std::vector<double> robust_costs(const PoseGraph& graph, const std::vector<std::size_t>& component,
                                 const std::vector<SE3>& T_map_node, const Weights& weights,
                                 const Loss& loss);

/// r' Omega r of one factor.
double squared_residual(const RelativeFactor& factor, const std::vector<SE3>& T_map_node);
double squared_residual(const PositionFactor& factor, const std::vector<SE3>& T_map_node);

}  // namespace cambium::pose_solver
