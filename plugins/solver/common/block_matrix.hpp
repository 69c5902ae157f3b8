// SPDX-License-Identifier: BSD-3-Clause
// A symmetric matrix of 6 x 6 blocks, one row of blocks an unknown pose. Only the lower triangle is
// kept, in the compressed columns that the Cholesky factorisation reads.
#pragma once
#include <utility>

#include "common/cholesky.hpp"

namespace cambium::pose_solver {

using Block = Eigen::Matrix<double, 6, 6>;

class BlockMatrix {
 public:
  /// Where an off-diagonal block stands: below the diagonal of `column`, the `index`-th.
  struct Slot {
    int column = 0, index = 0;
  };

  /// `couplings` (row > column) may repeat.
  BlockMatrix(int blocks, const std::vector<std::pair<int, int>>& couplings);

  Slot slot(int row, int column) const;
  void set_zero() { values_.assign(values_.size(), 0.0); }
  void add_diagonal(int block, const Block& value);  ///< symmetric
  void add(Slot slot, const Block& value);

  const LowerPattern& pattern() const { return pattern_; }
  const std::vector<double>& values() const { return values_; }
  int blocks() const { return int(rows_.size()); }
  Eigen::VectorXd diagonal() const;
  /// The values with `factor` times `scale` added to the diagonal.
  std::vector<double> damped(const Eigen::VectorXd& scale, double factor) const;
  Eigen::VectorXd operator*(const Eigen::VectorXd& x) const;

 private:
  LowerPattern pattern_;
  std::vector<double> values_;
  std::vector<std::vector<int>> rows_;  ///< block rows below the diagonal, by block column
};

}  // namespace cambium::pose_solver
