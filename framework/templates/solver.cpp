// SPDX-License-Identifier: BSD-3-Clause
// Relaxation: node after node moves to where its constraints want it on average. Slow, but short.
// Replace solve() by your method; the cost to minimise is that of cambium/pose_graph.hpp.
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public Solver {
 public:
  void params(ParamVisitor& v) override {
    v("sweeps", sweeps_, "Rounds through all nodes", between(1, 100000));
  }

  Solution solve(const PoseGraph& graph, const Context& context) const override {
    Solution best;
    best.T_map_node = graph.T_map_node;
    best.weight.assign(graph.relative.size(), 1.0);
    double lowest = cost(graph, best.T_map_node);
    std::vector<SE3> poses = graph.T_map_node;
    for (; best.iterations < sweeps_; ++best.iterations) {
      context.check_cancelled();
      for (std::size_t i = 0; i < poses.size(); ++i)
        if (i >= graph.fixed.size() || !graph.fixed[i]) relax(graph, i, poses);
      const double F = cost(graph, poses);
      if (!(F < lowest)) break;  // never raise the cost
      lowest = F;
      best.T_map_node = poses;
    }
    best.converged = true;
    best.message = "no sweep lowered the cost further, or their number was reached";
    return best;
  }

 private:
  // Half of the weighted mean of the steps that the constraints of node i ask for.
  static void relax(const PoseGraph& graph, std::size_t i, std::vector<SE3>& poses) {
    Vec6 step = Vec6::Zero(), weight = Vec6::Zero();
    const auto pull = [&](const SE3& wanted, const Mat6& information) {
      const Vec6 w = information.diagonal().cwiseMax(0.0);
      step += w.cwiseProduct((poses[i].inverse() * wanted).log());
      weight += w;
    };
    for (const RelativeFactor& f : graph.relative) {
      if (f.tail == i) pull(poses[f.head] * f.T_tail_head.inverse(), f.information);
      if (f.head == i) pull(poses[f.tail] * f.T_tail_head, f.information);
    }
    for (const PriorFactor& f : graph.priors)
      if (f.node == i) pull(f.T_map_node, f.information);
    const Vec6 safe = weight.cwiseMax(1e-12);
    poses[i] = poses[i] * SE3::exp(0.5 * step.cwiseQuotient(safe));
  }

  int sweeps_ = 200;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Relaxes node after node");
}
