// SPDX-License-Identifier: BSD-3-Clause
#include "model.hpp"

#include "common/costs.hpp"
#include "common/jacobians.hpp"

namespace cambium::sparse_lm {

using namespace pose_solver;

double Model::cost(const State& s) const {
  return loss_.switchable() ? switched_cost(graph_, s.T_map_node, weights_, loss_, s.switches)
                            : robust_cost(graph_, s.T_map_node, weights_, loss_);
}

void Model::linearize(const State& s) {
  equations_.linearize(s.T_map_node, weights_, loss_, &s.switches);
}

/// r' Omega J d, d the step of both ends.
double Model::jacobian_times(const RelativeFactor& f, const State& s, const Vec6& r,
                             const Eigen::VectorXd& step) const {
  const Jacobians J(f.T_tail_head, s.T_map_node[f.tail].rotation().transpose(), r);
  const auto& elimination = equations_.elimination();
  const int tail = elimination.place(f.tail), head = elimination.place(f.head);
  Eigen::Matrix<double, 6, 1> Jd = Eigen::Matrix<double, 6, 1>::Zero();
  if (tail >= 0) Jd += J.tail * step.segment<6>(6 * tail);
  if (head >= 0) Jd += J.head * step.segment<6>(6 * head);
  return Jd.dot(f.information * r);
}

// Of the row of a switch b in Robustified::switched, solved for b + db.
State Model::moved(const State& before, const Eigen::VectorXd& step) const {
  State out{equations_.moved(before.T_map_node, step), before.switches};
  if (!loss_.switchable()) return out;
  const auto& T = before.T_map_node;
  const auto move = [&](double& b, double s, double rJd) {
    b = loss_.best_switch(s) - b * rJd / (s + loss_.width_squared());
  };
  for (std::size_t k = 0; k < graph_.relative.size(); ++k) {
    const auto& f = graph_.relative[k];
    if (!f.robust) continue;
    const Vec6 r = residual(f.T_tail_head, T[f.tail], T[f.head]);
    const double rJd = f.tail == f.head ? 0 : jacobian_times(f, before, r, step);
    move(out.switches.relative[k], r.dot(f.information * r), rJd);
  }
  for (std::size_t k = 0; k < graph_.positions.size(); ++k) {
    const auto& f = graph_.positions[k];
    if (!f.robust) continue;
    const int place = equations_.elimination().place(f.node);
    const Vec3 Omega_r = f.information * Vec3(T[f.node].t - f.t_map);
    const double rJd = place < 0 ? 0 : step.segment<3>(6 * place).dot(Omega_r);
    move(out.switches.positions[k], squared_residual(f, T), rJd);
  }
  return out;
}

double Model::gain_of_switches(const State& state) const {
  if (!loss_.switchable()) return 0;
  double gain = 0;
  const auto add = [&](double weight, double b, double s) {
    const double change = b - loss_.best_switch(s);
    gain += weight * change * change * (s + loss_.width_squared());
  };
  for (std::size_t k = 0; k < graph_.relative.size(); ++k)
    if (const auto& f = graph_.relative[k]; f.robust)
      add(weights_.relative[k], state.switches.relative[k], squared_residual(f, state.T_map_node));
  for (std::size_t k = 0; k < graph_.positions.size(); ++k)
    if (const auto& f = graph_.positions[k]; f.robust)
      add(weights_.positions[k], state.switches.positions[k],
          squared_residual(f, state.T_map_node));
  return gain;
}

}  // namespace cambium::sparse_lm
