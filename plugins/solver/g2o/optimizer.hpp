// SPDX-License-Identifier: BSD-3-Clause
// A pose graph in g2o.
#pragma once
#include <g2o/core/sparse_optimizer.h>

#include "common/loss.hpp"
#include "common/problem.hpp"
#include "common/weights.hpp"

namespace cambium::g2o_solver {

/// Every node a vertex of its index, held ones fixed; one more, fixed, is the map's origin, from
/// which priors lead to their nodes. Factors that no pose moves are left out.
void fill(g2o::SparseOptimizer& optimizer, const pose_solver::Problem& problem,
          const std::vector<SE3>& start, const pose_solver::Weights& weights,
          const pose_solver::Loss& loss);

/// The poses of `start` with those of the vertices that are not fixed.
std::vector<SE3> poses(const g2o::SparseOptimizer& optimizer, const std::vector<SE3>& start);

}  // namespace cambium::g2o_solver
