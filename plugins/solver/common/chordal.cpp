// SPDX-License-Identifier: BSD-3-Clause
#include "common/chordal.hpp"

#include <algorithm>

#include "common/cholesky.hpp"

namespace cambium::pose_solver {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

constexpr Index known = -1;

struct Link {
  const RelativeFactor* factor;
  double weight;
};

/// Factors with the weight of one block of their information. No weight is below a millionth of the
/// largest, so that a factor without information still connects its nodes.
std::vector<Link> links(const PoseGraph& graph, const std::vector<bool>& use, Index block) {
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

/// The place of each node among the unknowns, in an order that keeps the Cholesky factor sparse.
/// It is found on the graph of nodes: three times fewer than the rows of the rotation system.
std::vector<Index> order(const PoseGraph& graph, const std::vector<bool>& anchored,
                         const std::vector<bool>& use) {
  std::vector<Index> unknown(anchored.size(), known);
  Index count = 0;
  for (std::size_t i = 0; i < anchored.size(); ++i)
    if (!anchored[i]) unknown[i] = count++;
  std::vector<std::pair<int, int>> couplings;
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    if (use[k] && unknown[f.tail] != known && unknown[f.head] != known)
      couplings.emplace_back(unknown[f.tail], unknown[f.head]);
  }
  const auto place = elimination_order(int(count), couplings);
  for (auto& u : unknown)
    if (u != known) u = place[std::size_t(u)];
  return unknown;
}

void add_lower(Triplets& H, Index row, Index col, const Matrix3d& block) {
  for (Index r = 0; r < 3; ++r)
    for (Index c = 0; c < 3; ++c)
      if (3 * row + r >= 3 * col + c) H.emplace_back(3 * row + r, 3 * col + c, block(r, c));
}

bool solve(Index size, const Triplets& triplets, Eigen::MatrixX3d& b) {
  Sparse H(size, size);
  H.setFromTriplets(triplets.begin(), triplets.end());
  const LowerPattern pattern = pattern_of(H);
  Cholesky cholesky(pattern);
  if (!cholesky.factorize(H.valuePtr())) return false;
  b = cholesky.solve(b);
  return b.allFinite();
}

/// With M = R^T a factor reads M_head = R_tail_head^T M_tail, and the three columns of M are free
/// of each other: one system, three right hand sides.
bool relax_rotations(const std::vector<Link>& links, const std::vector<Index>& unknown, Index count,
                     std::vector<SE3>& poses) {
  Triplets H;
  H.reserve(links.size() * 15);
  Eigen::MatrixX3d M = Eigen::MatrixX3d::Zero(3 * count, 3);
  for (const auto& [f, w] : links) {
    const Index i = unknown[f->tail], j = unknown[f->head];
    const Matrix3d wR = w * f->T_tail_head.rotation();
    for (const Index own : {i, j})
      if (own != known)
        for (Index r = 0; r < 3; ++r) H.emplace_back(3 * own + r, 3 * own + r, w);
    if (i != known && j != known) {
      if (i > j) add_lower(H, i, j, -wR);
      if (j > i) add_lower(H, j, i, -wR.transpose());
    } else if (j != known) {
      M.middleRows<3>(3 * j) += wR.transpose() * poses[f->tail].rotation().transpose();
    } else if (i != known) {
      M.middleRows<3>(3 * i) += wR * poses[f->head].rotation().transpose();
    }
  }
  if (!solve(3 * count, H, M)) return false;
  for (std::size_t n = 0; n < poses.size(); ++n) {
    if (unknown[n] == known) continue;
    Mat4 T = Mat4::Identity();
    T.topLeftCorner<3, 3>() = M.middleRows<3>(3 * unknown[n]).transpose();
    poses[n].q = SE3::from_matrix(T).q;
  }
  return true;
}

bool solve_translations(const std::vector<Link>& links, const std::vector<Index>& unknown,
                        Index count, std::vector<SE3>& poses) {
  Triplets H;
  H.reserve(links.size() * 3);
  Eigen::MatrixX3d t = Eigen::MatrixX3d::Zero(count, 3);
  for (const auto& [f, w] : links) {
    const Index i = unknown[f->tail], j = unknown[f->head];
    const Eigen::RowVector3d step = w * (poses[f->tail].q * f->T_tail_head.t).transpose();
    if (i != known) {
      H.emplace_back(i, i, w);
      t.row(i) -= step;
      if (j == known) t.row(i) += w * poses[f->head].t.transpose();
    }
    if (j != known) {
      H.emplace_back(j, j, w);
      t.row(j) += step;
      if (i == known) t.row(j) += w * poses[f->tail].t.transpose();
    }
    if (i != known && j != known) H.emplace_back(std::max(i, j), std::min(i, j), -w);
  }
  if (!solve(count, H, t)) return false;
  for (std::size_t n = 0; n < poses.size(); ++n)
    if (unknown[n] != known) poses[n].t = t.row(unknown[n]).transpose();
  return true;
}

}  // namespace

std::vector<SE3> chordal_poses(const PoseGraph& graph, const std::vector<bool>& anchored,
                               const std::vector<bool>& use) {
  std::vector<SE3> poses = graph.T_map_node;
  const auto count = Index(std::count(anchored.begin(), anchored.end(), false));
  if (count == 0) return poses;
  const auto unknown = order(graph, anchored, use);
  if (!relax_rotations(links(graph, use, 3), unknown, count, poses)) return {};
  if (!solve_translations(links(graph, use, 0), unknown, count, poses)) return {};
  return poses;
}

}  // namespace cambium::pose_solver
