// SPDX-License-Identifier: BSD-3-Clause
#include "triangle_index.hpp"

#include <tuple>

namespace tree_match {

TriangleIndex::TriangleIndex(std::vector<Triangle> triangles, const IndexLimits& limits)
    : cell_(std::max(1, int(std::lround(1000 * limits.cell)))),
      probe_(limits.probe),
      max_dbh_(int(std::lround(100 * limits.max_dbh_difference))),
      max_dz_(int(std::lround(20 * limits.max_height_difference))),
      triangles_(std::move(triangles)) {
  int longest = 0;  // of the middle sides
  for (const Triangle& t : triangles_) longest = std::max(longest, int(t.side[1]));
  rows_ = 1 + longest / cell_;
  const auto row = [&](const Triangle& t) {
    return row_of(t.clockwise, t.side[0] / cell_, t.side[1] / cell_);
  };
  // Stable: equal triangles keep the order of their stems.
  std::stable_sort(triangles_.begin(), triangles_.end(), [&](const Triangle& s, const Triangle& t) {
    return std::tuple(row(s), s.side[2]) < std::tuple(row(t), t.side[2]);
  });
  begin_.assign(2 * std::size_t(rows_) * std::size_t(rows_) + 1, 0);
  for (const Triangle& t : triangles_) ++begin_[row(t) + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
}

}  // namespace tree_match
