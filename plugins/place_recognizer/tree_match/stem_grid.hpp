// SPDX-License-Identifier: BSD-3-Clause
// Finds stems by their place: square cells, row by row, so that a search reads a few runs of
// memory.
#pragma once
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "stem_map.hpp"

namespace tree_match {

class StemGrid {
 public:
  explicit StemGrid(std::span<const Stem> stems);

  /// Calls visit(index, squared distance) for every stem within `radius` of (x, y).
  template <class Visit>
  void within(float x, float y, float radius, Visit visit) const {
    const int left = clamped(x - radius - x_low_, columns_),
              right = clamped(x + radius - x_low_, columns_),
              low = clamped(y - radius - y_low_, rows_), high = clamped(y + radius - y_low_, rows_);
    const float limit = radius * radius;
    for (int row = low; row <= high; ++row) {
      const std::uint32_t end = begin_[cell(right, row) + 1];
      for (std::uint32_t i = begin_[cell(left, row)]; i < end; ++i) {
        const float dx = entries_[i].x - x, dy = entries_[i].y - y, squared = dx * dx + dy * dy;
        if (squared <= limit) visit(entries_[i].stem, squared);
      }
    }
  }

 private:
  struct Entry {
    float x, y;
    std::uint32_t stem;
  };
  /// The cell of an offset from the lowest corner; what lies outside counts as the outermost cell.
  int clamped(float offset, int count) const {
    return int(std::clamp(offset * per_metre_, 0.0f, float(count - 1)));
  }
  std::size_t cell(int column, int row) const {
    return std::size_t(row) * std::size_t(columns_) + std::size_t(column);
  }

  float x_low_ = 0, y_low_ = 0, per_metre_ = 1;
  int columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> begin_;  // of each cell in entries_, and their end
  std::vector<Entry> entries_;
};

}  // namespace tree_match
