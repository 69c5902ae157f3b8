// SPDX-License-Identifier: BSD-3-Clause
#include "common/normal_equations.hpp"

#include "common/jacobians.hpp"
#include "common/robustified.hpp"

namespace cambium::pose_solver {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A robust factor that is to be switched has its own value; else the best one.
template <int N>
void apply(const Loss& loss, double s, const double* b, double weight, Robustified<N>& factor) {
  if (loss.switchable())
    factor.switched(loss, s, b ? *b : loss.best_switch(s), weight);
  else
    factor.reweigh(loss.weight(s));
}

}  // namespace

NormalEquations::NormalEquations(const PoseGraph& graph, const Elimination& elimination)
    : graph_(graph), elimination_(elimination), H_(elimination), slots_(graph.relative.size()) {
  for (std::size_t k = 0; k < slots_.size(); ++k)
    if (const auto& f = graph.relative[k]; elimination.couples(f))
      slots_[k] = H_.slot(elimination.place(f.tail), elimination.place(f.head));
}

void NormalEquations::add(int place, const Block& H, const Vector6& g) {
  if (place < 0) return;
  H_.add_diagonal(place, H);
  g_.segment<6>(6 * place) += g;
}

void NormalEquations::add_relative(std::size_t k, const std::vector<SE3>& poses, double weight,
                                   const Loss& loss, const double* switch_of) {
  const auto& f = graph_.relative[k];
  const int tail = elimination_.place(f.tail), head = elimination_.place(f.head);
  if (tail == head || weight == 0) return;  // no pose moves it: both held, or one node
  const Vec6 r = residual(f.T_tail_head, poses[f.tail], poses[f.head]);
  Robustified<6> factor(f.information, r, weight);
  if (f.robust) apply(loss, r.dot(f.information * r), switch_of, weight, factor);
  const Jacobians J(f.T_tail_head, poses[f.tail].rotation().transpose(), r);
  const Block Omega_tail = factor.Omega * J.tail, Omega_head = factor.Omega * J.head;
  add(tail, J.tail.transpose() * Omega_tail, J.tail.transpose() * factor.Omega_r);
  add(head, J.head.transpose() * Omega_head, J.head.transpose() * factor.Omega_r);
  if (tail < 0 || head < 0) return;
  H_.add(slots_[k],
         tail > head ? J.tail.transpose() * Omega_head : J.head.transpose() * Omega_tail);
}

void NormalEquations::add_absolute(const std::vector<SE3>& poses) {
  for (const auto& f : graph_.priors) {
    const Vector6 r = residual(f.T_map_node, SE3{}, poses[f.node]);
    const Jacobians J(f.T_map_node, Eigen::Matrix3d::Identity(), r);
    const Block Omega_J = Block(f.information) * J.head;
    add(elimination_.place(f.node), J.head.transpose() * Omega_J, Omega_J.transpose() * r);
  }
  for (const auto& f : graph_.attitude) {
    const Eigen::Vector3d up = poses[f.node].q.conjugate() * Vec3::UnitZ(), u = f.up_node;
    const Eigen::Matrix3d J =
        (Eigen::Matrix3d::Identity() - u * u.transpose()) * skew(up) / f.sigma;
    Block H = Block::Zero();
    H.bottomRightCorner<3, 3>() = J.transpose() * J;
    Vector6 g = Vector6::Zero();
    g.tail<3>() = J.transpose() * (up - u * u.dot(up)) / f.sigma;
    add(elimination_.place(f.node), H, g);
  }
}

void NormalEquations::add_position(std::size_t k, const std::vector<SE3>& poses, double weight,
                                   const Loss& loss, const double* switch_of) {
  const auto& f = graph_.positions[k];
  const Vec3 r = poses[f.node].t - f.t_map;
  Robustified<3> factor(f.information, r, weight);
  if (f.robust) apply(loss, r.dot(f.information * r), switch_of, weight, factor);
  Block H = Block::Zero();
  H.topLeftCorner<3, 3>() = factor.Omega;
  Vector6 g = Vector6::Zero();
  g.head<3>() = factor.Omega_r;
  add(elimination_.place(f.node), H, g);
}

void NormalEquations::linearize(const std::vector<SE3>& poses, const Weights& weights,
                                const Loss& loss, const Weights* switches) {
  H_.set_zero();
  g_ = Eigen::VectorXd::Zero(6 * H_.blocks());
  for (std::size_t k = 0; k < graph_.relative.size(); ++k)
    add_relative(k, poses, weights.relative[k], loss, switches ? &switches->relative[k] : nullptr);
  for (std::size_t k = 0; k < graph_.positions.size(); ++k)
    add_position(k, poses, weights.positions[k], loss,
                 switches ? &switches->positions[k] : nullptr);
  add_absolute(poses);
}

std::vector<SE3> NormalEquations::moved(const std::vector<SE3>& poses,
                                        const Eigen::VectorXd& step) const {
  std::vector<SE3> out = poses;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (elimination_.place(i) < 0) continue;
    const Vector6 d = step.segment<6>(6 * elimination_.place(i));
    Vec6 turn = Vec6::Zero();
    turn.tail<3>() = d.tail<3>();
    out[i].t += d.head<3>();
    out[i].q = (out[i].q * SE3::exp(turn).q).normalized();
  }
  return out;
}

}  // namespace cambium::pose_solver
