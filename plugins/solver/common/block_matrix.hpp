// SPDX-License-Identifier: BSD-3-Clause
// A symmetric matrix of N x N blocks, one row of blocks an unknown pose. Only the lower triangle is
// kept, in the compressed columns that the Cholesky factorisation reads.
#pragma once
#include <Eigen/Core>

#include "common/elimination.hpp"

namespace cambium::pose_solver {

template <int N>
class BlockMatrix {
 public:
  using Block = Eigen::Matrix<double, N, N>;
  /// Where an off-diagonal block stands: below the diagonal of `column`, the `index`-th.
  struct Slot {
    int column = 0, index = 0;
  };

  /// Zero, with the blocks of `elimination`, which must outlive it.
  explicit BlockMatrix(const Elimination& elimination);

  /// Of the places of two poses, either order.
  Slot slot(int a, int b) const;
  void set_zero() { values_.assign(values_.size(), 0.0); }
  void add_diagonal(int block, const Block& value);  ///< symmetric
  void add(Slot slot, const Block& value);

  const LowerPattern& pattern() const { return pattern_; }
  const std::vector<double>& values() const { return values_; }
  int blocks() const { return blocks_.size(); }
  Eigen::VectorXd diagonal() const;
  /// The values with `factor` times `scale` added to the diagonal.
  std::vector<double> damped(const Eigen::VectorXd& scale, double factor) const;
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;

 private:
  const LowerPattern& blocks_;
  LowerPattern pattern_;
  std::vector<double> values_;
};

using Block = BlockMatrix<6>::Block;

}  // namespace cambium::pose_solver
