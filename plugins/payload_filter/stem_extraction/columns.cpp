// SPDX-License-Identifier: BSD-3-Clause
#include "columns.hpp"

#include <algorithm>
#include <tuple>

namespace stem_extraction {

Columns::Columns(std::vector<Above> points) : points_(points.size()) {
  for (const Above& p : points)
    range_ = std::max({range_, std::abs(p.position.x()), std::abs(p.position.y())});
  width_ = int(std::ceil(2 * range_ / cell)) + 1;
  const auto column = [&](const Above& p) {
    return index(row(p.position.x()), row(p.position.y()));
  };
  begin_.assign(std::size_t(width_) * std::size_t(width_) + 1, 0);
  for (const Above& p : points) ++begin_[column(p) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (const Above& p : points) points_[next[column(p)]++] = p;
  const auto order = [](const Above& p) {
    return std::tuple(p.position.z(), p.position.y(), p.position.x());
  };
  for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
    std::sort(points_.begin() + std::ptrdiff_t(begin_[i]),
              points_.begin() + std::ptrdiff_t(begin_[i + 1]),
              [&](const Above& a, const Above& b) { return order(a) < order(b); });
}

}  // namespace stem_extraction
