// SPDX-License-Identifier: BSD-3-Clause
#include "common/costs.hpp"

namespace cambium::pose_solver {

double squared_residual(const RelativeFactor& f, const std::vector<SE3>& T) {
  const Vec6 r = residual(f.T_tail_head, T[f.tail], T[f.head]);
  return r.dot(f.information * r);
}

double squared_residual(const PositionFactor& f, const std::vector<SE3>& T) {
  const Vec3 r = T[f.node].t - f.t_map;
  return r.dot(f.information * r);
}

namespace {

/// `add(node, cost)` of every factor, in a fixed order. `switches` may be null.
template <class Add>
void visit(const PoseGraph& graph, const std::vector<SE3>& T, const Weights& weights,
           const Loss& loss, const Weights* switches, const Add& add) {
  const auto robust = [&](double s, bool is_robust, auto list, std::size_t k) {
    if (!is_robust) return s;
    return switches ? loss.switched(s, ((*switches).*list)[k]) : loss.value(s);
  };
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    add(f.tail,
        weights.relative[k] * robust(squared_residual(f, T), f.robust, &Weights::relative, k));
  }
  for (const auto& f : graph.priors) {
    const Vec6 r = residual(f.T_map_node, SE3{}, T[f.node]);
    add(f.node, r.dot(f.information * r));
  }
  for (std::size_t k = 0; k < graph.positions.size(); ++k) {
    const auto& f = graph.positions[k];
    add(f.node,
        weights.positions[k] * robust(squared_residual(f, T), f.robust, &Weights::positions, k));
  }
  for (const auto& f : graph.attitude) {
    const Vec3 up = T[f.node].q.conjugate() * Vec3::UnitZ();
    const Vec3 r = up - f.up_node * f.up_node.dot(up);
    add(f.node, r.squaredNorm() / (f.sigma * f.sigma));
  }
}

}  // namespace

double robust_cost(const PoseGraph& graph, const std::vector<SE3>& T, const Weights& weights,
                   const Loss& loss) {
  double F = 0;
  visit(graph, T, weights, loss, nullptr, [&](std::size_t, double f) { F += f; });
  return F;
}

double switched_cost(const PoseGraph& graph, const std::vector<SE3>& T, const Weights& weights,
                     const Loss& loss, const Weights& switches) {
  double F = 0;
  visit(graph, T, weights, loss, &switches, [&](std::size_t, double f) { F += f; });
  return F;
}

std::vector<double> robust_costs(const PoseGraph& graph, const std::vector<std::size_t>& component,
                                 const std::vector<SE3>& T, const Weights& weights,
                                 const Loss& loss) {
  std::vector<double> F(T.size());  // by component; the tail is unused
  visit(graph, T, weights, loss, nullptr,
        [&](std::size_t node, double f) { F[component[node]] += f; });
  return F;
}

}  // namespace cambium::pose_solver
