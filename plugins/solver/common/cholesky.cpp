// SPDX-License-Identifier: BSD-3-Clause
#include "common/cholesky.hpp"

#include <sys/mman.h>

#include <cmath>
#include <cstdlib>

namespace cambium::pose_solver {

namespace {

/// Memory for the values of a factor, in huge pages where the system has them: a factor is written
/// once or twice and then thrown away, and a fifth of that time went into ten thousand small pages.
double* huge(std::size_t count) {
  constexpr std::size_t page = std::size_t{1} << 21;
  const std::size_t bytes = (count * sizeof(double) + page - 1) / page * page;
  void* memory = bytes > page ? std::aligned_alloc(page, bytes) : std::malloc(bytes);
  if (memory && bytes > page) madvise(memory, bytes, MADV_HUGEPAGE);
  return static_cast<double*>(memory);
}

}  // namespace

void Cholesky::Free::operator()(double* memory) const { std::free(memory); }

Cholesky::Cholesky(const Elimination& elimination, int block, const LowerPattern& pattern)
    : pattern_(pattern), factor_(elimination.symbolic_factor(block, settings_)) {
  if (!factor_ || !factor_->is_super) return;
  values_.reset(huge(factor_->xsize));
  if (!values_) return;
  factor_->x = values_.get();
  factor_->xtype = CHOLMOD_REAL;
}

Cholesky::~Cholesky() {
  if (factor_ && values_) {  // CHOLMOD does not own them
    factor_->x = nullptr;
    factor_->xtype = CHOLMOD_PATTERN;
  }
  cholmod_free_factor(&factor_, settings_);
}

bool Cholesky::factorize(const double* values, double shift) {
  if (!factor_) return false;
  cholmod_sparse A = view(pattern_, values);
  double beta[2] = {shift, 0};
  cholmod_factorize_p(&A, beta, nullptr, 0, factor_, settings_);
  return settings_->status == CHOLMOD_OK && factor_->minor == factor_->n;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& b) const { return solve(CHOLMOD_A, b); }

// Places are in the order of elimination, so there is no permutation to undo.
Eigen::MatrixXd Cholesky::draw(const Eigen::MatrixXd& white) const {
  return solve(CHOLMOD_Lt, white);
}

Eigen::MatrixXd Cholesky::solve(int system, const Eigen::MatrixXd& b) const {
  cholmod_dense B{};
  B.nrow = B.d = std::size_t(b.rows());
  B.ncol = std::size_t(b.cols());
  B.nzmax = B.nrow * B.ncol;
  B.x = const_cast<double*>(b.data());
  B.xtype = CHOLMOD_REAL;
  B.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* x = cholmod_solve(system, factor_, &B, settings_);
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
