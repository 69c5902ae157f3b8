// SPDX-License-Identifier: BSD-3-Clause
// A pose graph as a GTSAM factor graph. The key of a variable is the index of its node; a node that
// is held is no variable, and enters the factors that it has with others.
#pragma once
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/nonlinear/Values.h>

#include "common/problem.hpp"
#include "common/weights.hpp"
#include "factors.hpp"

namespace cambium::gtsam_solver {

struct FactorGraph {
  gtsam::NonlinearFactorGraph factors;  ///< those that a variable moves
  gtsam::Values start;                  ///< of every variable that a factor moves
};

FactorGraph factor_graph(const pose_solver::Problem& problem, const std::vector<SE3>& start,
                         const pose_solver::Weights& weights, const pose_solver::Loss& loss);

/// The poses of `start` with those of the variables.
std::vector<SE3> poses(const std::vector<SE3>& start, const gtsam::Values& values);

}  // namespace cambium::gtsam_solver
