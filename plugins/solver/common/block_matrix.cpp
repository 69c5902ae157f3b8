// SPDX-License-Identifier: BSD-3-Clause
#include "common/block_matrix.hpp"

#include <algorithm>

namespace cambium::pose_solver {

BlockMatrix::BlockMatrix(int blocks, const std::vector<std::pair<int, int>>& couplings)
    : rows_(static_cast<std::size_t>(blocks)) {
  for (const auto& [row, column] : couplings) rows_[std::size_t(column)].push_back(row);
  auto& start = pattern_.column_start;
  for (int c = 0; c < blocks; ++c) {
    auto& rows = rows_[std::size_t(c)];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int k = 0; k < 6; ++k) {
      start.push_back(int(pattern_.row.size()));
      for (int r = k; r < 6; ++r) pattern_.row.push_back(6 * c + r);
      for (const int block : rows)
        for (int r = 0; r < 6; ++r) pattern_.row.push_back(6 * block + r);
    }
  }
  start.push_back(int(pattern_.row.size()));
  values_.assign(pattern_.row.size(), 0.0);
}

BlockMatrix::Slot BlockMatrix::slot(int row, int column) const {
  const auto& rows = rows_[std::size_t(column)];
  return {column, int(std::lower_bound(rows.begin(), rows.end(), row) - rows.begin())};
}

void BlockMatrix::add_diagonal(int block, const Block& value) {
  for (int k = 0; k < 6; ++k) {
    double* column = values_.data() + pattern_.column_start[std::size_t(6 * block + k)];
    for (int r = k; r < 6; ++r) column[r - k] += value(r, k);
  }
}

void BlockMatrix::add(Slot slot, const Block& value) {
  for (int k = 0; k < 6; ++k) {
    double* column = values_.data() + pattern_.column_start[std::size_t(6 * slot.column + k)] +
                     (6 - k) + 6 * slot.index;
    for (int r = 0; r < 6; ++r) column[r] += value(r, k);
  }
}

Eigen::VectorXd BlockMatrix::diagonal() const {
  Eigen::VectorXd out(pattern_.size());
  for (int c = 0; c < pattern_.size(); ++c)
    out[c] = values_[std::size_t(pattern_.column_start[std::size_t(c)])];
  return out;
}

std::vector<double> BlockMatrix::damped(const Eigen::VectorXd& scale, double factor) const {
  std::vector<double> out = values_;
  for (int c = 0; c < pattern_.size(); ++c)
    out[std::size_t(pattern_.column_start[std::size_t(c)])] += factor * scale[c];
  return out;
}

Eigen::VectorXd BlockMatrix::operator*(const Eigen::VectorXd& x) const {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (int c = 0; c < pattern_.size(); ++c) {
    const int begin = pattern_.column_start[std::size_t(c)];
    const int end = pattern_.column_start[std::size_t(c) + 1];
    double sum = values_[std::size_t(begin)] * x[c];
    for (int i = begin + 1; i < end; ++i) {
      const int r = pattern_.row[std::size_t(i)];
      y[r] += values_[std::size_t(i)] * x[c];
      sum += values_[std::size_t(i)] * x[r];
    }
    y[c] += sum;
  }
  return y;
}

}  // namespace cambium::pose_solver
