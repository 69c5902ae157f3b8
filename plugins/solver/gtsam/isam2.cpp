// SPDX-License-Identifier: BSD-3-Clause
#include <gtsam/linear/linearExceptions.h>
#include <gtsam/nonlinear/ISAM2.h>

#include <algorithm>

#include "optimizers.hpp"

namespace cambium::gtsam_solver {
namespace {

/// Of a batch optimum nothing may be left undone: no variable keeps an old linearisation for more
/// than this (m, rad), and no change is too small to be propagated.
gtsam::ISAM2Params settings() {
  gtsam::ISAM2Params out;
  out.optimizationParams = gtsam::ISAM2GaussNewtonParams(0.0);
  out.relinearizeThreshold = 1e-4;
  out.relinearizeSkip = 1;
  return out;
}

/// The factors by the last of their variables, each list in the order of the graph.
std::map<gtsam::Key, gtsam::NonlinearFactorGraph> by_last_key(
    const gtsam::NonlinearFactorGraph& all) {
  std::map<gtsam::Key, gtsam::NonlinearFactorGraph> out;
  for (const auto& factor : all)
    out[*std::max_element(factor->begin(), factor->end())].push_back(factor);
  return out;
}

void add_nodes(gtsam::ISAM2& isam, const FactorGraph& graph, int at_once, const Context& context) {
  auto factors = by_last_key(graph.factors);
  gtsam::NonlinearFactorGraph new_factors;
  gtsam::Values new_poses;
  for (const gtsam::Key key : graph.start.keys()) {
    new_poses.insert(key, graph.start.at(key));
    if (const auto found = factors.find(key); found != factors.end())
      new_factors.push_back(found->second);
    if (int(new_poses.size()) < at_once && key != graph.start.keys().back()) continue;
    context.check_cancelled();
    isam.update(new_factors, new_poses);
    new_factors.resize(0);
    new_poses.clear();
  }
}

}  // namespace

pose_solver::Minimum isam2(const FactorGraph& graph, const std::vector<SE3>& start, int at_once,
                           const pose_solver::Limits& limits, const Context& context) {
  pose_solver::Minimum out{start, 0, false, "reached the limit of iterations"};
  try {
    gtsam::ISAM2 isam(settings());
    add_nodes(isam, graph, at_once, context);
    double error = graph.factors.error(isam.calculateEstimate());
    while (!out.converged && out.iterations < limits.iterations) {
      context.check_cancelled();
      isam.update();
      ++out.iterations;
      const double now = graph.factors.error(isam.calculateEstimate());
      out.converged = std::abs(error - now) <= limits.tolerance * now;
      error = now;
    }
    if (out.converged) out.message = "the cost changes no more";
    out.T_map_node = poses(start, isam.calculateBestEstimate());
    out.cost = 2 * error;
  } catch (const gtsam::IndeterminantLinearSystemException& e) {
    out.message = "iSAM2 has no damping and needs every pose tied: node " +
                  std::to_string(e.nearbyVariable()) + " of the graph is not";
  }
  return out;
}

}  // namespace cambium::gtsam_solver
