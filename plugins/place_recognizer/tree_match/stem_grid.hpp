// SPDX-License-Identifier: BSD-3-Clause
// Finds stems by their place: rows of equal y, each sorted by x. Small, and quick to walk through.
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
    const int low = std::max(0, row_of(y - radius)), high = std::min(rows_ - 1, row_of(y + radius));
    for (int row = low; row <= high; ++row) {
      const auto end = entries_.begin() + begin_[std::size_t(row) + 1];
      auto it = std::lower_bound(entries_.begin() + begin_[std::size_t(row)], end, x - radius,
                                 [](const Entry& e, float v) { return e.x < v; });
      for (; it != end && it->x <= x + radius; ++it) {
        const float dx = it->x - x, dy = it->y - y, squared = dx * dx + dy * dy;
        if (squared <= radius * radius) visit(it->stem, squared);
      }
    }
  }

 private:
  struct Entry {
    float x, y;
    std::uint32_t stem;
  };
  /// Clamped before the conversion: far away is outside, whatever the distance.
  int row_of(float y) const {
    return int(std::clamp(std::floor((y - y_low_) / row_height), -1.0f, float(rows_)));
  }

  static constexpr float row_height = 1.5f;  // [m]
  float y_low_ = 0;
  int rows_ = 0;
  std::vector<std::ptrdiff_t> begin_;  // of each row in entries_, and their end
  std::vector<Entry> entries_;
};

}  // namespace tree_match
