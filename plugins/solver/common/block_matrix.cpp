// SPDX-License-Identifier: BSD-3-Clause
#include "common/block_matrix.hpp"

#include <algorithm>

namespace cambium::pose_solver {

template <int N>
BlockMatrix<N>::BlockMatrix(const Elimination& elimination) : blocks_(elimination.pattern()) {
  const std::size_t count = blocks_.row.size();
  pattern_.column_start.reserve(std::size_t(N * blocks_.size()) + 1);
  pattern_.row.reserve(N * N * count);
  for (int c = 0; c < blocks_.size(); ++c) {
    const int begin = blocks_.column_start[std::size_t(c)];
    const int end = blocks_.column_start[std::size_t(c) + 1];
    for (int k = 0; k < N; ++k) {
      pattern_.column_start.push_back(int(pattern_.row.size()));
      for (int r = k; r < N; ++r) pattern_.row.push_back(N * c + r);
      for (int b = begin + 1; b < end; ++b)
        for (int r = 0; r < N; ++r) pattern_.row.push_back(N * blocks_.row[std::size_t(b)] + r);
    }
  }
  pattern_.column_start.push_back(int(pattern_.row.size()));
  values_.assign(pattern_.row.size(), 0.0);
}

template <int N>
typename BlockMatrix<N>::Slot BlockMatrix<N>::slot(int a, int b) const {
  const int column = std::min(a, b), row = std::max(a, b);
  const auto first = blocks_.row.begin() + blocks_.column_start[std::size_t(column)] + 1;
  const auto last = blocks_.row.begin() + blocks_.column_start[std::size_t(column) + 1];
  return {column, int(std::lower_bound(first, last, row) - first)};
}

template <int N>
void BlockMatrix<N>::add_diagonal(int block, const Block& value) {
  for (int k = 0; k < N; ++k) {
    double* column = values_.data() + pattern_.column_start[std::size_t(N * block + k)];
    for (int r = k; r < N; ++r) column[r - k] += value(r, k);
  }
}

template <int N>
void BlockMatrix<N>::add(Slot slot, const Block& value) {
  for (int k = 0; k < N; ++k) {
    double* column = values_.data() + pattern_.column_start[std::size_t(N * slot.column + k)] +
                     (N - k) + N * slot.index;
    for (int r = 0; r < N; ++r) column[r] += value(r, k);
  }
}

template <int N>
Eigen::VectorXd BlockMatrix<N>::diagonal() const {
  Eigen::VectorXd out(pattern_.size());
  for (int c = 0; c < pattern_.size(); ++c)
    out[c] = values_[std::size_t(pattern_.column_start[std::size_t(c)])];
  return out;
}

template <int N>
std::vector<double> BlockMatrix<N>::damped(const Eigen::VectorXd& scale, double factor) const {
  std::vector<double> out = values_;
  for (int c = 0; c < pattern_.size(); ++c)
    out[std::size_t(pattern_.column_start[std::size_t(c)])] += factor * scale[c];
  return out;
}

template <int N>
Eigen::VectorXd BlockMatrix<N>::operator*(const Eigen::VectorXd& x) const {
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

template class BlockMatrix<1>;  // positions
template class BlockMatrix<3>;  // rotations
template class BlockMatrix<6>;  // poses

}  // namespace cambium::pose_solver
