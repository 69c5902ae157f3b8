// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation with g2o on the one cost of cambium/pose_graph.hpp. See README.md.
#include <g2o/core/block_solver.h>
#include <g2o/core/hyper_graph_action.h>
#include <g2o/core/optimization_algorithm_levenberg.h>
#include <g2o/solvers/cholmod/linear_solver_cholmod.h>

#include "cambium/plugin.hpp"
#include "common/solve.hpp"
#include "optimizer.hpp"

namespace cambium::g2o_solver {
namespace {

using Blocks = g2o::BlockSolver<g2o::BlockSolverTraits<6, 6>>;

std::unique_ptr<g2o::OptimizationAlgorithmLevenberg> levenberg() {
  auto linear = std::make_unique<g2o::LinearSolverCholmod<Blocks::PoseMatrixType>>();
  linear->setBlockOrdering(true);  // order poses, not their six columns
  auto out = std::make_unique<g2o::OptimizationAlgorithmLevenberg>(
      std::make_unique<Blocks>(std::move(linear)));
  // The chordal start is good, so the first steps are nearly those of Gauss and Newton.
  out->setUserLambdaInit(1e-9);
  return out;
}

/// Raises g2o's stop flag after an iteration that changed little, or when the caller wants it.
class Stop final : public g2o::HyperGraphAction {
 public:
  Stop(g2o::SparseOptimizer& optimizer, double tolerance, const Context& context)
      : optimizer_(optimizer), tolerance_(tolerance), context_(context) {
    optimizer.setForceStopFlag(&stop_);
    optimizer.addPostIterationAction(this);
    optimizer.computeActiveErrors();
    cost_ = optimizer.activeRobustChi2();
  }
  g2o::HyperGraphAction* operator()(const g2o::HyperGraph*, Parameters*) override {
    optimizer_.computeActiveErrors();
    const double now = optimizer_.activeRobustChi2();
    converged_ = cost_ - now <= tolerance_ * now;
    cost_ = now;
    stop_ = converged_ || context_.cancelled();
    return this;
  }
  bool converged() const { return converged_; }
  double cost() const { return cost_; }

 private:
  g2o::SparseOptimizer& optimizer_;
  double tolerance_, cost_ = 0;
  const Context& context_;
  bool stop_ = false, converged_ = false;
};

class G2oMinimizer final : public pose_solver::Minimizer {
 public:
  explicit G2oMinimizer(const pose_solver::Problem& problem) : problem_(problem) {}

  pose_solver::Minimum run(const std::vector<SE3>& start, const pose_solver::Weights& weights,
                           const pose_solver::Loss& loss, const pose_solver::Limits& limits,
                           const Context& context) override {
    context.check_cancelled();
    g2o::SparseOptimizer optimizer;
    optimizer.setAlgorithm(levenberg().release());
    fill(optimizer, problem_, start, weights, loss);
    if (optimizer.edges().empty()) return {start, 0, true, "nothing moves"};
    optimizer.initializeOptimization();
    Stop stop(optimizer, limits.tolerance, context);
    const int iterations = optimizer.optimize(limits.iterations);
    context.check_cancelled();
    pose_solver::Minimum out{poses(optimizer, start), std::max(0, iterations), stop.converged(),
                             stop.converged() ? "the cost changes no more"
                             : iterations < limits.iterations
                                 ? "g2o found no step that lowers the cost"
                                 : "reached the limit of iterations"};
    out.cost = stop.cost();
    return out;
  }

 private:
  const pose_solver::Problem& problem_;
};

}  // namespace
}  // namespace cambium::g2o_solver

CAMBIUM_PLUGIN("g2o", "0.1.0") {
  registry.add<cambium::pose_solver::SolverWith<cambium::g2o_solver::G2oMinimizer>>(
      "g2o", "Levenberg-Marquardt of g2o on CHOLMOD, for comparison with it");
}
