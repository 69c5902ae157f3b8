// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation with GTSAM on the one cost of cambium/pose_graph.hpp. See README.md.
#include "cambium/plugin.hpp"
#include "common/solve.hpp"
#include "optimizers.hpp"

namespace cambium::gtsam_solver {
namespace {

struct Method {
  std::string name = "batch";
  int nodes_an_update = 100;
};

class GtsamMinimizer final : public pose_solver::Minimizer {
 public:
  GtsamMinimizer(const pose_solver::Problem& problem, const Method& method)
      : problem_(problem), method_(method) {}

  pose_solver::Minimum run(const std::vector<SE3>& start, const pose_solver::Weights& weights,
                           const pose_solver::Loss& loss, const pose_solver::Limits& limits,
                           const Context& context) override {
    context.check_cancelled();
    const FactorGraph graph = factor_graph(problem_, start, weights, loss);
    if (graph.start.empty()) return {start, 0, true, "nothing moves"};
    return method_.name == "isam2" ? isam2(graph, start, method_.nodes_an_update, limits, context)
                                   : batch(graph, start, limits, context);
  }

 private:
  const pose_solver::Problem& problem_;
  const Method method_;
};

class GtsamSolver final : public Solver {
 public:
  void params(ParamVisitor& v) override {
    settings_.params(v);
    v("method", method_.name,
      "`batch`: Levenberg-Marquardt over all poses at once; `isam2`: pose after pose, as on a "
      "robot",
      one_of({"batch", "isam2"}));
    v("nodes_an_update", method_.nodes_an_update, "How many poses `isam2` takes in at once",
      between(1, 1000000));
  }

  Solution solve(const PoseGraph& graph, const Context& context) const override {
    return pose_solver::solve(settings_, graph, context, [&](const pose_solver::Problem& problem) {
      return std::make_unique<GtsamMinimizer>(problem, method_);
    });
  }

 private:
  pose_solver::Settings settings_;
  Method method_;
};

}  // namespace
}  // namespace cambium::gtsam_solver

CAMBIUM_PLUGIN("gtsam", "0.1.0") {
  registry.add<cambium::gtsam_solver::GtsamSolver>(
      "gtsam", "Levenberg-Marquardt or iSAM2 of GTSAM, for comparison with it");
}
