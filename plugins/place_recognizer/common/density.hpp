// SPDX-License-Identifier: BSD-3-Clause
// Bird's-eye pictures of how many points lie where.
#pragma once
#include <span>

#include "cambium/payload.hpp"

namespace columns {

struct DensityGrid {
  bool polar = true;  ///< rows are rings and columns sectors; else rows are y and columns x
  int rows = 32, cols = 64;
  double max_range = 40.0;                ///< radius, or half the side [m]
  double lowest = -1.0, highest = 6.0;    ///< of the points that count, above the base [m]

  std::size_t size() const { return std::size_t(rows) * std::size_t(cols); }
};

/// Writes log(1 + count) of the levelled points in every bin, divided by the largest of them, row by
/// row: 0..1, and all 0 when no point is inside.
void density_image(const cambium::Cloud::Matrix3X& points, const DensityGrid& grid,
                   std::span<float> image);

}  // namespace columns
