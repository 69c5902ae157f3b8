// SPDX-License-Identifier: BSD-3-Clause
#include "common/chordal.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/block_matrix.hpp"
#include "common/cholesky.hpp"

namespace cambium::pose_solver {
namespace {

using Eigen::Matrix3d;

struct Link {
  const RelativeFactor* factor;
  double weight;
};

/// Factors with the weight of one block of their information. No weight is below a millionth of the
/// largest, so that a factor without information still connects its nodes.
std::vector<Link> links(const PoseGraph& graph, const std::vector<bool>& use, Eigen::Index block) {
  std::vector<Link> out;
  double largest = 0;
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    if (!use[k] || f.tail == f.head) continue;
    out.push_back({&f, f.information.diagonal().segment<3>(block).sum() / 3.0});
    largest = std::max(largest, out.back().weight);
  }
  const double floor = largest > 0 ? 1e-6 * largest : 1.0;
  for (auto& link : out) link.weight = std::max(link.weight, floor);
  return out;
}

template <int N>
bool solve(const Elimination& elimination, const BlockMatrix<N>& H, Eigen::MatrixX3d& b) {
  Cholesky cholesky(elimination, N, H.pattern());
  if (!cholesky.factorize(H.values().data())) return false;
  b = cholesky.solve(b);
  return b.allFinite();
}

/// The nearest rotation: Newton's iteration for the polar decomposition (Higham 1986), as long as
/// the determinant is positive, which it is but for nonsense; else by singular values.
Quat nearest_rotation(const Matrix3d& A) {
  Matrix3d R = A / std::cbrt(std::abs(A.determinant()));
  for (int k = 0; k < 20 && R.allFinite() && R.determinant() > 0; ++k) {
    const Matrix3d next = 0.5 * (R + R.inverse().transpose());
    const double change = (next - R).cwiseAbs().maxCoeff();
    R = next;
    if (change < 1e-14) return Quat(Eigen::Quaterniond(R)).normalized();
  }
  Mat4 T = Mat4::Identity();
  T.topLeftCorner<3, 3>() = A;
  return SE3::from_matrix(T).q;
}

/// With M = R^T a factor reads M_head = R_tail_head^T M_tail, and the three columns of M are free
/// of each other: one system, three right hand sides.
bool relax_rotations(const std::vector<Link>& links, const Elimination& elimination,
                     std::vector<SE3>& poses) {
  BlockMatrix<3> H(elimination);
  Eigen::MatrixX3d M = Eigen::MatrixX3d::Zero(3 * elimination.count(), 3);
  for (const auto& [f, w] : links) {
    const int i = elimination.place(f->tail), j = elimination.place(f->head);
    const Matrix3d wR = w * Matrix3d(f->T_tail_head.rotation());
    for (const int own : {i, j})
      if (own >= 0) H.add_diagonal(own, w * Matrix3d::Identity());
    if (elimination.couples(*f))
      H.add(H.slot(i, j), i > j ? Matrix3d(-wR) : Matrix3d(-wR.transpose()));
    else if (j >= 0)
      M.middleRows<3>(3 * j) += wR.transpose() * poses[f->tail].rotation().transpose();
    else if (i >= 0)
      M.middleRows<3>(3 * i) += wR * poses[f->head].rotation().transpose();
  }
  if (!solve(elimination, H, M)) return false;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    if (elimination.place(n) < 0) continue;
    poses[n].q = nearest_rotation(M.middleRows<3>(3 * elimination.place(n)).transpose());
  }
  return true;
}

bool solve_translations(const std::vector<Link>& links, const Elimination& elimination,
                        std::vector<SE3>& poses) {
  using Scalar = BlockMatrix<1>::Block;
  BlockMatrix<1> H(elimination);
  Eigen::MatrixX3d t = Eigen::MatrixX3d::Zero(elimination.count(), 3);
  for (const auto& [f, w] : links) {
    const int i = elimination.place(f->tail), j = elimination.place(f->head);
    const Eigen::RowVector3d step = w * (poses[f->tail].q * f->T_tail_head.t).transpose();
    if (i >= 0) {
      H.add_diagonal(i, Scalar(w));
      t.row(i) -= step;
      if (j < 0) t.row(i) += w * poses[f->head].t.transpose();
    }
    if (j >= 0) {
      H.add_diagonal(j, Scalar(w));
      t.row(j) += step;
      if (i < 0) t.row(j) += w * poses[f->tail].t.transpose();
    }
    if (elimination.couples(*f)) H.add(H.slot(i, j), Scalar(-w));
  }
  if (!solve(elimination, H, t)) return false;
  for (std::size_t n = 0; n < poses.size(); ++n)
    if (elimination.place(n) >= 0) poses[n].t = t.row(elimination.place(n)).transpose();
  return true;
}

}  // namespace

std::vector<SE3> chordal_poses(const PoseGraph& graph, const Elimination& elimination,
                               const std::vector<bool>& use) {
  std::vector<SE3> poses = graph.T_map_node;
  if (elimination.count() == 0) return poses;
  if (!relax_rotations(links(graph, use, 3), elimination, poses)) return {};
  if (!solve_translations(links(graph, use, 0), elimination, poses)) return {};
  return poses;
}

}  // namespace cambium::pose_solver
