// SPDX-License-Identifier: BSD-3-Clause
#include <gtsam/nonlinear/LevenbergMarquardtOptimizer.h>

#include "optimizers.hpp"

namespace cambium::gtsam_solver {

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
  if (optimizer.lambda() >= params.lambdaUpperBound) {
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
