// SPDX-License-Identifier: BSD-3-Clause
#include "common/normal_equations.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::pose_solver {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Couplings = std::vector<std::pair<int, int>>;

Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

std::vector<int> places(const PoseGraph& graph, const std::vector<bool>& held) {
  std::vector<int> place(held.size(), -1);
  int count = 0;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) place[i] = count++;
  Couplings couplings;
  for (const auto& f : graph.relative)
    if (place[f.tail] >= 0 && place[f.head] >= 0)
      couplings.emplace_back(place[f.tail], place[f.head]);
  const auto order = elimination_order(count, couplings);
  for (int& p : place)
    if (p >= 0) p = order[std::size_t(p)];
  return place;
}

Couplings below_diagonal(const PoseGraph& graph, const std::vector<int>& place) {
  Couplings out;
  for (const auto& f : graph.relative) {
    const int a = place[f.tail], b = place[f.head];
    if (a >= 0 && b >= 0 && a != b) out.emplace_back(std::max(a, b), std::min(a, b));
  }
  return out;
}

/// dr/d(tail) and dr/d(head). With dq = (w, v) the residual's rotation is 2 v, so r tells all.
struct Jacobians {
  Block tail = Block::Zero(), head = Block::Zero();
  Jacobians(const SE3& T_tail_head, const Eigen::Matrix3d& R_tail_map, const Vector6& r) {
    const Eigen::Vector3d t = r.head<3>() + T_tail_head.t, v = 0.5 * r.tail<3>();
    const Eigen::Matrix3d w =
        std::sqrt(std::max(0.0, 1 - v.squaredNorm())) * Eigen::Matrix3d::Identity();
    tail.topLeftCorner<3, 3>() = -R_tail_map;
    tail.topRightCorner<3, 3>() = skew(t);
    tail.bottomRightCorner<3, 3>() = (skew(v) - w) * T_tail_head.rotation().transpose();
    head.topLeftCorner<3, 3>() = R_tail_map;
    head.bottomRightCorner<3, 3>() = w + skew(v);
  }
};

}  // namespace

NormalEquations::NormalEquations(const PoseGraph& graph, const std::vector<bool>& held)
    : graph_(graph),
      place_(places(graph, held)),
      H_(int(std::count(held.begin(), held.end(), false)), below_diagonal(graph, place_)),
      slots_(graph.relative.size()) {
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    const int a = place_[graph.relative[k].tail], b = place_[graph.relative[k].head];
    if (a >= 0 && b >= 0 && a != b) slots_[k] = H_.slot(std::max(a, b), std::min(a, b));
  }
}

void NormalEquations::add(int place, const Block& H, const Vector6& g) {
  if (place < 0) return;
  H_.add_diagonal(place, H);
  g_.segment<6>(6 * place) += g;
}

void NormalEquations::add_relative(const RelativeFactor& f, const BlockMatrix::Slot& slot,
                                   double weight, const std::vector<SE3>& poses, const Loss& loss) {
  const int tail = place_[f.tail], head = place_[f.head];
  if (tail == head) return;  // both held, or one node: no pose moves it
  const Vector6 r = residual(f.T_tail_head, poses[f.tail], poses[f.head]);
  if (f.robust) weight *= loss.weight(r.dot(f.information * r));
  if (weight == 0) return;
  const Jacobians J(f.T_tail_head, poses[f.tail].rotation().transpose(), r);
  const Block Omega = weight * f.information;
  const Block Omega_tail = Omega * J.tail, Omega_head = Omega * J.head;
  add(tail, J.tail.transpose() * Omega_tail, Omega_tail.transpose() * r);
  add(head, J.head.transpose() * Omega_head, Omega_head.transpose() * r);
  if (tail < 0 || head < 0) return;
  H_.add(slot, tail > head ? J.tail.transpose() * Omega_head : J.head.transpose() * Omega_tail);
}

void NormalEquations::add_absolute(const std::vector<SE3>& poses, const Weights& weights,
                                   const Loss& loss) {
  for (const auto& f : graph_.priors) {
    const Vector6 r = residual(f.T_map_node, SE3{}, poses[f.node]);
    const Jacobians J(f.T_map_node, Eigen::Matrix3d::Identity(), r);
    const Block Omega_J = Block(f.information) * J.head;
    add(place_[f.node], J.head.transpose() * Omega_J, Omega_J.transpose() * r);
  }
  for (const auto& f : graph_.attitude) {
    const Eigen::Vector3d up = poses[f.node].q.conjugate() * Vec3::UnitZ(), u = f.up_node;
    const Eigen::Matrix3d J =
        (Eigen::Matrix3d::Identity() - u * u.transpose()) * skew(up) / f.sigma;
    Block H = Block::Zero();
    H.bottomRightCorner<3, 3>() = J.transpose() * J;
    Vector6 g = Vector6::Zero();
    g.tail<3>() = J.transpose() * (up - u * u.dot(up)) / f.sigma;
    add(place_[f.node], H, g);
  }
  for (std::size_t k = 0; k < graph_.positions.size(); ++k) {
    const auto& f = graph_.positions[k];
    const Vec3 r = poses[f.node].t - f.t_map;
    const double s = r.dot(f.information * r);
    const double weight = weights.positions[k] * (f.robust ? loss.weight(s) : 1.0);
    Block H = Block::Zero();
    H.topLeftCorner<3, 3>() = weight * f.information;
    Vector6 g = Vector6::Zero();
    g.head<3>() = weight * (f.information * r);
    add(place_[f.node], H, g);
  }
}

void NormalEquations::linearize(const std::vector<SE3>& poses, const Weights& weights,
                                const Loss& loss) {
  H_.set_zero();
  g_ = Eigen::VectorXd::Zero(6 * H_.blocks());
  for (std::size_t k = 0; k < graph_.relative.size(); ++k)
    add_relative(graph_.relative[k], slots_[k], weights.relative[k], poses, loss);
  add_absolute(poses, weights, loss);
}

std::vector<SE3> NormalEquations::moved(const std::vector<SE3>& poses,
                                        const Eigen::VectorXd& step) const {
  std::vector<SE3> out = poses;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (place_[i] < 0) continue;
    const Vector6 d = step.segment<6>(6 * place_[i]);
    Vec6 turn = Vec6::Zero();
    turn.tail<3>() = d.tail<3>();
    out[i].t += d.head<3>();
    out[i].q = (out[i].q * SE3::exp(turn).q).normalized();
  }
  return out;
}

}  // namespace cambium::pose_solver
