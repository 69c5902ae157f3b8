// SPDX-License-Identifier: BSD-3-Clause
#include "common/cholesky.hpp"

#include <cmath>

namespace cambium::pose_solver {

Cholesky::Cholesky(const Elimination& elimination, int block, const LowerPattern& pattern)
    : pattern_(pattern), factor_(elimination.symbolic_factor(block, settings_)) {}

Cholesky::~Cholesky() { cholmod_free_factor(&factor_, settings_); }

bool Cholesky::factorize(const double* values, double shift) {
  if (!factor_) return false;
  cholmod_sparse A = view(pattern_, values);
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&A, beta, nullptr, 0, factor_, settings_);
  return settings_->status == CHOLMOD_OK && factor_->minor == factor_->n;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& b) const {
  cholmod_dense B{};
  B.nrow = B.d = std::size_t(b.rows());
  B.ncol = std::size_t(b.cols());
  B.nzmax = B.nrow * B.ncol;
  B.x = const_cast<double*>(b.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, &B, settings_);
  if (!x) return Eigen::MatrixXd::Constant(b.rows(), b.cols(), NAN);
  Eigen::MatrixXd out =
      Eigen::Map<const Eigen::MatrixXd>(static_cast<const double*>(x->x), b.rows(), b.cols());
  cholmod_free_dense(&x, settings_);
  return out;
}

double Cholesky::condition() const {
  const double reciprocal = cholmod_rcond(factor_, settings_);
  return reciprocal > 0 ? 1 / reciprocal : INFINITY;
}

}  // namespace cambium::pose_solver
