// SPDX-License-Identifier: BSD-3-Clause
// Supernodal sparse Cholesky of a matrix whose pattern stays while its values change (CHOLMOD: Y.
// Chen, T. Davis, W. Hager, S. Rajamanickam, ACM TOMS 35(3), 2008).
#pragma once
#include <cholmod.h>

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace cambium::pose_solver {

/// The lower triangle, column by column, rows ascending. The diagonal is full.
struct LowerPattern {
  std::vector<int> column_start;  ///< one more than there are columns
  std::vector<int> row;
  int size() const { return int(column_start.size()) - 1; }
};

/// Of a matrix that has its diagonal and nothing above it.
LowerPattern pattern_of(const Eigen::SparseMatrix<double>& lower);

class Cholesky {
 public:
  /// The symbolic analysis. The unknowns must come in a fill-reducing order already.
  explicit Cholesky(const LowerPattern& pattern);
  ~Cholesky();
  Cholesky(const Cholesky&) = delete;
  Cholesky& operator=(const Cholesky&) = delete;

  /// The matrix plus `shift` times the identity, `values` as `pattern.row`. False: it is not
  /// positive definite.
  bool factorize(const double* values, double shift = 0);
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right_hand_side) const;
  /// Of the matrix, estimated from the diagonal of its factor: a lower bound.
  double condition() const;

 private:
  const LowerPattern& pattern_;
  mutable cholmod_common common_{};
  cholmod_factor* factor_ = nullptr;
};

/// The place of each of `count` unknowns in an elimination order that keeps the factor of a matrix
/// with these couplings sparse: minimum degree or nested dissection, whichever fills less.
std::vector<int> elimination_order(int count, const std::vector<std::pair<int, int>>& couplings);

}  // namespace cambium::pose_solver
