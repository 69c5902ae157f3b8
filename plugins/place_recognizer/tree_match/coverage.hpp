// SPDX-License-Identifier: BSD-3-Clause
// Where a mission has seen stems, and when first.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "stem_map.hpp"

namespace tree_match {

/// A raster of 1 m (coarser above 2 km): precise enough for whether a stem should have been seen.
class Coverage {
 public:
  /// A place is covered by the stems within `radius` [m].
  Coverage(std::span<const Stem> stems, double radius);

  /// Whether a stem near (x, y) was last seen before node `end`.
  bool before(float x, float y, std::uint32_t end) const {
    const float column = (x - x_low_) * per_metre_, row = (y - y_low_) * per_metre_;
    return column >= 0 && row >= 0 && column < float(columns_) && row < float(rows_) &&
           earliest_[std::size_t(row) * std::size_t(columns_) + std::size_t(column)] < end;
  }

 private:
  float x_low_ = 0, y_low_ = 0, per_metre_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> earliest_;  // of the last sightings of the stems around a cell
};

}  // namespace tree_match
