// SPDX-License-Identifier: BSD-3-Clause
// A levelled cloud seen from above: how many layers of each column are filled.
#pragma once
#include <array>
#include <vector>

#include "cambium/payload.hpp"

namespace bev_density {

struct PictureGrid {
  double cell = 0.25;       ///< edge of a pixel [m]
  double max_range = 40.0;  ///< points farther from the base, horizontally, do not count [m]
  double lowest = -3.0, highest = 12.0;  ///< of the points that count, above the base [m]
  int layers = 32;                       ///< between lowest and highest, at most 64

  int side() const { return 2 * int(max_range / cell + 0.5); }  ///< pixels a row
};

/// Column x + side * y; x and y from -max_range on.
struct Picture {
  int side = 0;
  std::vector<std::uint8_t> brightness;  ///< filled layers over those of the fullest column, 0..255
  std::vector<float> bottom;             ///< the lowest point of the column [m]; NaN: none
};

/// The same for any order of the points, and for any number of them in a voxel: what is dense
/// because it is near, or was scanned twice, is no brighter.
Picture make_picture(const cambium::Cloud::Matrix3X& levelled, const PictureGrid& grid);

}  // namespace bev_density
