// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/pose_graph.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <numeric>

namespace cambium {
namespace {

/// r' Omega r. Of an indefinite Omega the nearest positive semi-definite matrix counts, as it does
/// for solvers: a cost is never negative.
template <class Matrix, class Vector>
double squared(const Matrix& information, const Vector& r) {
  constexpr int n = Matrix::RowsAtCompileTime;
  const Eigen::Matrix<double, n, n> Omega = 0.5 * (information + information.transpose());
  if (Omega.llt().info() == Eigen::Success) return r.dot(information * r);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> eigen(Omega);
  const Eigen::Matrix<double, n, 1> along = eigen.eigenvectors().transpose() * r;
  return along.cwiseAbs2().dot(eigen.eigenvalues().cwiseMax(0.0));
}

}  // namespace

Vec6 residual(const SE3& T_tail_head, const SE3& T_map_tail, const SE3& T_map_head) {
  // Files give quaternions to six digits; the residual is that of the rotation they stand for.
  const Quat inv = T_map_tail.q.normalized().conjugate();
  // The difference is taken before the rotation: in a map of UTM size the other order loses digits.
  const Vec3 t = inv * Vec3(T_map_head.t - T_map_tail.t);
  const Quat dq = (T_tail_head.q.conjugate() * inv * T_map_head.q).normalized();
  Vec6 r;
  r << t - T_tail_head.t, (dq.w() < 0 ? -2.0 : 2.0) * dq.vec();
  return r;
}

double cost(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
            const std::vector<double>& weight) {
  double F = 0;
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    const Vec6 r = residual(f.T_tail_head, T_map_node[f.tail], T_map_node[f.head]);
    F += (weight.empty() ? 1.0 : weight[k]) * squared(f.information, r);
  }
  for (const auto& f : graph.attitude) {
    const Vec3 up = T_map_node[f.node].q.normalized().conjugate() * Vec3::UnitZ();
    const Vec3 r = up - f.up_node * f.up_node.dot(up);
    F += r.squaredNorm() / (f.sigma * f.sigma);
  }
  for (const auto& f : graph.priors) {
    const Vec6 r = residual(f.T_map_node, SE3{}, T_map_node[f.node]);
    F += squared(f.information, r);
  }
  for (const auto& f : graph.positions) {
    const Vec3 r = T_map_node[f.node].t - f.t_map;
    F += squared(f.information, r);
  }
  return F;
}

std::vector<std::size_t> components(const PoseGraph& graph) {
  std::vector<std::size_t> parent(graph.T_map_node.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const auto& f : graph.relative) {
    const std::size_t a = root(f.tail), b = root(f.head);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::size_t> number(parent.size()), out(parent.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < parent.size(); ++i) {
    if (root(i) == i) number[i] = next++;
    out[i] = number[root(i)];
  }
  return out;
}

}  // namespace cambium
