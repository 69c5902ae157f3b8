// SPDX-License-Identifier: BSD-3-Clause
// Supernodal sparse Cholesky of a matrix whose pattern stays while its values change (CHOLMOD: Y.
// Chen, T. Davis, W. Hager, S. Rajamanickam, ACM TOMS 35(3), 2008).
#pragma once
#include <Eigen/Core>
#include <memory>

#include "common/elimination.hpp"

namespace cambium::pose_solver {

class Cholesky {
 public:
  /// Of matrices of `block` x `block` blocks in the order of `elimination`. The pattern must have
  /// no entry outside of its blocks, and outlive this.
  Cholesky(const Elimination& elimination, int block, const LowerPattern& pattern);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// The matrix plus `shift` times the identity, `values` as `pattern.row`. False: it is not
  /// positive definite.
  bool factorize(const double* values, double shift = 0);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_side) const;
  /// L'^-1 `white`, with L L' the matrix (of blocks): columns of independent numbers of variance 1
  /// become columns whose covariance is the matrix's inverse.
  Eigen::MatrixXd draw(const Eigen::MatrixXd& white) const;
  /// Of the matrix, estimated from the diagonal of its factor: a lower bound.
  double condition() const;

 private:
  /// `system`: CHOLMOD_A, CHOLMOD_Lt.
  Eigen::MatrixXd solve(int system, const Eigen::MatrixXd& right_hand_side) const;

  struct Free {
    void operator()(double* memory) const;
  };

  const LowerPattern& pattern_;
  mutable CholmodSettings settings_;
  cholmod_factor* factor_ = nullptr;
  std::unique_ptr<double, Free> values_;  ///< of the factor
};

}  // namespace cambium::pose_solver
