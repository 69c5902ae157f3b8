// SPDX-License-Identifier: BSD-3-Clause
#include <gtsam/linear/VectorValues.h>
#include <gtsam/linear/linearExceptions.h>
#include <gtsam/nonlinear/LevenbergMarquardtOptimizer.h>

#include <algorithm>

#include "optimizers.hpp"

namespace cambium::gtsam_solver {
namespace {

/// Not even the undamped step moves a pose by more than rounding does (m, rad).
bool rests(const FactorGraph& graph, const gtsam::Values& at) try {
  const gtsam::VectorValues step = graph.factors.linearize(at)->optimize();
  return std::all_of(step.begin(), step.end(),
                     [](const auto& of_pose) { return of_pose.second.norm() < 1e-9; });
} catch (const gtsam::IndeterminantLinearSystemException&) {
  return false;
}

}  // namespace

pose_solver::Minimum batch(const FactorGraph& graph, const std::vector<SE3>& start,
                           const pose_solver::Limits& limits, const Context& context) {
  gtsam::LevenbergMarquardtParams params;
  params.relativeErrorTol = limits.tolerance;  // when to give up lowering the damping
  // The chordal start is good, so the first steps are nearly those of Gauss and Newton. Marquardt's
  // scale keeps metres and radians apart.
  params.lambdaInitial = 1e-10;
  params.diagonalDamping = true;
  gtsam::LevenbergMarquardtOptimizer optimizer(graph.factors, graph.start, params);
  pose_solver::Minimum out{start, 0, false, "reached the limit of iterations"};
  while (!out.converged && out.iterations < limits.iterations) {
    context.check_cancelled();
    const double before = optimizer.error();
    optimizer.iterate();
    ++out.iterations;
    out.converged = before - optimizer.error() <= limits.tolerance * optimizer.error();
  }
  if (optimizer.lambda() >= params.lambdaUpperBound && !rests(graph, optimizer.values())) {
    out.converged = false;
    out.message = "no step lowers the cost";
  } else if (out.converged) {
    out.message = "the cost changes no more";
  }
  out.T_map_node = poses(start, optimizer.values());
  out.cost = 2 * optimizer.error();
  return out;
}

}  // namespace cambium::gtsam_solver
