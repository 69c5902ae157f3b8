// SPDX-License-Identifier: BSD-3-Clause
#include "coverage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tree_match {

Coverage::Coverage(std::span<const Stem> stems, double radius) {
  if (stems.empty()) return;
  constexpr float most = 2000.0f;  // cells a side
  const float around = float(radius);
  float x_high = x_low_ = stems[0].x, y_high = y_low_ = stems[0].y;
  for (const Stem& s : stems) {
    x_low_ = std::min(x_low_, s.x), x_high = std::max(x_high, s.x);
    y_low_ = std::min(y_low_, s.y), y_high = std::max(y_high, s.y);
  }
  x_low_ -= around, y_low_ -= around, x_high += around, y_high += around;
  per_metre_ = 1 / std::max({1.0f, (x_high - x_low_) / most, (y_high - y_low_) / most});
  columns_ = 1 + int((x_high - x_low_) * per_metre_);
  rows_ = 1 + int((y_high - y_low_) * per_metre_);
  earliest_.assign(std::size_t(columns_) * std::size_t(rows_),
                   std::numeric_limits<std::uint32_t>::max());
  const auto range = [&](float at, float low, int count) {  // of cells whose centres are near
    const float from = (at - around - low) * per_metre_, to = (at + around - low) * per_metre_;
    return std::pair(std::max(0, int(std::ceil(from - 0.5f))),
                     std::min(count - 1, int(std::floor(to - 0.5f))));
  };
  for (const Stem& s : stems) {
    const auto [left, right] = range(s.x, x_low_, columns_);
    const auto [low, high] = range(s.y, y_low_, rows_);
    for (int row = low; row <= high; ++row)
      for (int column = left; column <= right; ++column) {
        const float dx = x_low_ + (float(column) + 0.5f) / per_metre_ - s.x,
                    dy = y_low_ + (float(row) + 0.5f) / per_metre_ - s.y;
        if (dx * dx + dy * dy > around * around) continue;
        auto& earliest = earliest_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)];
        earliest = std::min(earliest, s.last);
      }
  }
}

}  // namespace tree_match
