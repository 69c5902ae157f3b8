// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation with Ceres: Levenberg-Marquardt on the one cost of
// cambium/pose_graph.hpp, sparse Cholesky (CHOLMOD). See README.md.
#include <ceres/iteration_callback.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include "cambium/plugin.hpp"
#include "common/solve.hpp"
#include "problem.hpp"

namespace cambium::ceres_solver {
namespace {

class StopWhenCancelled final : public ceres::IterationCallback {
 public:
  explicit StopWhenCancelled(const Context& context) : context_(context) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary&) override {
    return context_.cancelled() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }

 private:
  const Context& context_;
};

ceres::Solver::Options options_for(const pose_solver::Limits& limits) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = limits.tolerance;
  options.gradient_tolerance = 1e-14;
  options.parameter_tolerance = 1e-14;
  // The chordal start is good: begin with Gauss-Newton steps, which a failed one shortens.
  options.initial_trust_region_radius = 1e8;
  // With threads Ceres adds costs and gradients in the order in which they finish, so the last
  // bits would change from run to run.
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  return options;
}

class CeresMinimizer final : public pose_solver::Minimizer {
 public:
  explicit CeresMinimizer(const pose_solver::Problem& problem)
      : graph_(problem.graph), held_(problem.held) {}

  pose_solver::Minimum run(const std::vector<SE3>& start, const pose_solver::Weights& weights,
                           const pose_solver::Loss& loss, const pose_solver::Limits& limits,
                           const Context& context) override {
    PoseProblem pose_problem(graph_, start, held_, weights, loss);
    StopWhenCancelled callback(context);
    ceres::Solver::Options options = options_for(limits);
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &pose_problem.problem(), &summary);
    context.debug(summary.FullReport());
    context.check_cancelled();
    return {pose_problem.poses(), int(summary.iterations.size()) - 1,
            summary.termination_type == ceres::CONVERGENCE, summary.message,
            2 * (summary.final_cost - summary.fixed_cost)};
  }

 private:
  const PoseGraph& graph_;
  const std::vector<bool>& held_;
};

}  // namespace
}  // namespace cambium::ceres_solver

CAMBIUM_PLUGIN("ceres", "0.1.0") {
  // Ceres reports its troubles through glog, on stderr; here they are in Solution::message.
  FLAGS_minloglevel = google::GLOG_FATAL;
  registry.add<cambium::pose_solver::SolverWith<cambium::ceres_solver::CeresMinimizer>>(
      "ceres", "Levenberg-Marquardt with sparse Cholesky, robust losses and chordal start (Ceres)");
}
