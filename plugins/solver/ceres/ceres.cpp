// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation with Ceres: Levenberg-Marquardt on the one cost of
// cambium/pose_graph.hpp, sparse Cholesky (CHOLMOD). See README.md.
#include <ceres/iteration_callback.h>
#include <ceres/solver.h>
#include <fmt/format.h>
#include <glog/logging.h>

#include <numeric>

#include "cambium/plugin.hpp"
#include "checks.hpp"
#include "loss.hpp"
#include "problem.hpp"
#include "start.hpp"

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

class Ceres final : public Solver {
 public:
  void params(ParamVisitor& v) override {
    v("loss", loss_, "Robust loss on loops and positions; `none` trusts all of them",
      one_of(loss_names()));
    v("loss_width", loss_width_, "Residuals above this many sigmas count as suspicious",
      above(0.0, "sigma"));
    v("initialization", initialization_,
      "`chordal` looks for a better start than the given poses; `given` starts from them",
      one_of({"chordal", "given"}));
    v("max_iterations", max_iterations_, "Gives up after this many", between(1, 100000));
    v("tolerance", tolerance_, "Stops when a step lowers the cost by less than this fraction",
      above(0.0));
  }

  Solution solve(const PoseGraph& given, const Context& context) const override {
    const PoseGraph graph = checked(given, context);
    const Loss loss(loss_from(loss_), loss_width_);
    const auto component = components(graph);
    const auto held = held_nodes(graph, component);
    const auto start =
        initialization_ == "given" ? graph.T_map_node : chordal_start(graph, component, held, loss);
    context.check_cancelled();
    Solution solution = minimise(graph, start, held, loss, context);
    keep_the_better(graph, component, loss, solution);
    for (std::size_t i = 0; i < held.size(); ++i)  // to the last bit
      if (held[i]) solution.T_map_node[i] = given.T_map_node[i];
    for (const auto& f : graph.relative) {
      const Vec6 r =
          residual(f.T_tail_head, solution.T_map_node[f.tail], solution.T_map_node[f.head]);
      solution.weight.push_back(f.robust ? loss.weight(r.dot(f.information * r)) : 1.0);
    }
    return solution;
  }

 private:
  Solution minimise(const PoseGraph& graph, const std::vector<SE3>& start,
                    const std::vector<bool>& held, const Loss& loss, const Context& context) const {
    PoseProblem pose_problem(graph, start, held, loss);
    StopWhenCancelled callback(context);
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.sparse_linear_algebra_library_type = ceres::SUITE_SPARSE;
    options.max_num_iterations = max_iterations_;
    options.function_tolerance = tolerance_;
    options.gradient_tolerance = 1e-14;
    options.parameter_tolerance = 1e-14;
    // The chordal start is good: begin with Gauss-Newton steps, which a failed one shortens.
    options.initial_trust_region_radius = 1e8;
    // With threads Ceres adds costs and gradients in the order in which they finish, so the last
    // bits would change from run to run.
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.callbacks.push_back(&callback);
    ceres::Solver::Summary summary;
    ceres::Solve(options, &pose_problem.problem(), &summary);
    context.debug(summary.FullReport());
    context.check_cancelled();

    Solution solution;
    solution.T_map_node = pose_problem.poses();
    solution.iterations = int(summary.iterations.size()) - 1;
    solution.converged = summary.termination_type == ceres::CONVERGENCE;
    solution.message = summary.message;
    return solution;
  }

  /// Levenberg-Marquardt never climbs, but Ceres may fail; then the given poses stand.
  static void keep_the_better(const PoseGraph& graph, const std::vector<std::size_t>& component,
                              const Loss& loss, Solution& solution) {
    const auto F = [&](const std::vector<SE3>& poses) {
      const auto costs = robust_costs(graph, component, poses, loss);
      return std::accumulate(costs.begin(), costs.end(), 0.0);
    };
    const double before = F(graph.T_map_node), after = F(solution.T_map_node);
    if (!(after <= before)) solution.T_map_node = graph.T_map_node;
    solution.message += fmt::format("; F {:.6g} -> {:.6g}", before, std::min(after, before));
  }

  std::string loss_ = "none";
  double loss_width_ = 3.0;
  std::string initialization_ = "chordal";
  int max_iterations_ = 100;
  double tolerance_ = 1e-9;
};

}  // namespace
}  // namespace cambium::ceres_solver

CAMBIUM_PLUGIN("ceres", "0.1.0") {
  // Ceres reports its troubles through glog, on stderr; here they are in Solution::message.
  FLAGS_minloglevel = google::GLOG_FATAL;
  registry.add<cambium::ceres_solver::Ceres>(
      "ceres", "Levenberg-Marquardt with sparse Cholesky, robust losses and chordal start (Ceres)");
}
