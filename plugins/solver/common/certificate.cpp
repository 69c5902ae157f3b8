// SPDX-License-Identifier: BSD-3-Clause
#include "common/certificate.hpp"

#include <fmt/format.h>

#include <Eigen/SparseCore>
#include <algorithm>

#include "common/cholesky.hpp"

namespace cambium::pose_solver {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

bool isotropic(const Mat6& information) {
  Mat6 rest = information;
  rest.diagonal().head<3>().array() -= information(0, 0);
  rest.diagonal().tail<3>().array() -= information(3, 3);
  return rest.cwiseAbs().maxCoeff() <= 1e-6 * information.diagonal().maxCoeff();
}

std::string obstacle(const PoseGraph& graph) {
  if (!graph.attitude.empty() || !graph.priors.empty() || !graph.positions.empty())
    return "there are factors besides the relative ones";
  for (const auto& f : graph.relative)
    if (!isotropic(f.information))
      return fmt::format(
          "{}: the information is not one number for rotation and one for "
          "translation",
          f.label);
  return {};
}

/// Four rows a node, those of R_i' and t_i, the nodes in the order of elimination.
std::vector<int> first_rows(const Elimination& elimination) {
  std::vector<int> rows;
  for (int i = 0; i < elimination.count(); ++i)
    rows.push_back(4 * elimination.place(std::size_t(i)));
  return rows;
}

/// (omega / 2) |R_head - R_tail R_tail_head|_F^2 + tau |t_head - t_tail - R_tail t_tail_head|^2.
/// The first is omega |2 vec(dq)|^2, as both are 4 omega sin^2(angle / 2).
Sparse data_matrix(const PoseGraph& graph, const std::vector<int>& rows,
                   const std::vector<double>& weight) {
  Triplets M;
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    const double tau = weight[k] * f.information(0, 0);
    const double half = 0.5 * weight[k] * f.information(3, 3);
    const int i = rows[f.tail], j = rows[f.head];
    const Eigen::Matrix3d R = f.T_tail_head.rotation();
    for (int a = 0; a < 3; ++a) {
      M.emplace_back(i + a, i + a, half);
      M.emplace_back(j + a, j + a, half);
      for (int b = 0; b < 3; ++b) {
        M.emplace_back(i + a, j + b, -half * R(a, b));
        M.emplace_back(j + b, i + a, -half * R(a, b));
      }
    }
    const Vec3& t = f.T_tail_head.t;
    const std::pair<int, double> e[] = {
        {j + 3, 1.0}, {i + 3, -1.0}, {i, -t.x()}, {i + 1, -t.y()}, {i + 2, -t.z()}};
    for (const auto& [r, x] : e)
      for (const auto& [c, y] : e) M.emplace_back(r, c, tau * x * y);
  }
  const auto size = Eigen::Index(4 * rows.size());
  for (Eigen::Index d = 0; d < size; ++d) M.emplace_back(d, d, 0.0);  // also without any factor
  Sparse out(size, size);
  out.setFromTriplets(M.begin(), M.end());
  return out;
}

/// S = M - Lambda.
Sparse certificate_matrix(const Sparse& M, const std::vector<int>& rows,
                          const std::vector<SE3>& poses) {
  Eigen::MatrixX3d X(M.rows(), 3);  // transposed
  for (std::size_t i = 0; i < rows.size(); ++i) {
    X.middleRows<3>(rows[i]) = poses[i].rotation().transpose();
    X.row(rows[i] + 3) = poses[i].t.transpose();
  }
  const Eigen::MatrixX3d MX = M * X;
  Triplets Lambda;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Matrix3d L = MX.middleRows<3>(rows[i]) * Eigen::Matrix3d(poses[i].rotation());
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b)
        Lambda.emplace_back(rows[i] + a, rows[i] + b, 0.5 * (L(a, b) + L(b, a)));
  }
  Sparse blocks(M.rows(), M.cols());
  blocks.setFromTriplets(Lambda.begin(), Lambda.end());
  return M - blocks;
}

/// How far below zero the eigenvalues reach: the smallest shift that makes S positive definite, to
/// 1 %. Cholesky decides each trial, which no cluster of eigenvalues around zero disturbs.
double depth(const Elimination& elimination, const Sparse& S, double scale) {
  const Sparse lower = S.triangularView<Eigen::Lower>();
  const LowerPattern pattern{{lower.outerIndexPtr(), lower.outerIndexPtr() + lower.cols() + 1},
                             {lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros()}};
  Cholesky cholesky(elimination, 4, pattern);
  const auto positive = [&](double shift) {
    return cholesky.factorize(lower.valuePtr(), shift * scale);
  };
  if (positive(certificate_tolerance)) return 0;
  double low = certificate_tolerance, high = 10 * low;
  while (!positive(high)) low = high, high *= 10;
  while (high > 1.01 * low) {
    const double middle = std::sqrt(low * high);
    (positive(middle) ? high : low) = middle;
  }
  return high;
}

}  // namespace

Certificate certify(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                    const std::vector<double>& weight) {
  Certificate out;
  out.not_applicable = obstacle(graph);
  if (!out.not_applicable.empty() || graph.relative.empty()) return out;
  const Elimination elimination(graph, std::vector<bool>(graph.T_map_node.size()));
  const auto rows = first_rows(elimination);
  const Sparse M = data_matrix(graph, rows, weight);
  const double scale = M.diagonal().maxCoeff();
  out.smallest_eigenvalue = -depth(elimination, certificate_matrix(M, rows, T_map_node), scale);
  out.certified = out.smallest_eigenvalue >= -certificate_tolerance;
  return out;
}

}  // namespace cambium::pose_solver
