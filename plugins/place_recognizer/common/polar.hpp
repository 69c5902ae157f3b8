// SPDX-License-Identifier: BSD-3-Clause
// The polar context of one cloud: the highest point in every bin of a polar grid around the base.
// G. Kim, A. Kim, "Scan Context: Egocentric Spatial Descriptor for Place Recognition within 3D
// Point Cloud Map", IROS 2018, sections III-A and III-B.
#pragma once
#include <span>

#include "cambium/payload.hpp"
#include "common/shape.hpp"

namespace columns {

struct PolarGrid {
  Shape shape;
  double max_range = 80.0;     ///< horizontal radius of the outermost ring [m]
  double height_offset = 2.0;  ///< added to heights, so that the ground counts too [m]
};

/// Writes the descriptor of levelled points, as seen from `viewpoint`, to `columns`: sector by
/// sector, each column of `rings` heights scaled to unit length, so that the dot product of two
/// columns is the cosine of the paper's equation (6). A column without points is zero. Points
/// beyond max_range or lower than -height_offset count as not seen.
void describe(const cambium::Cloud::Matrix3X& points, const PolarGrid& grid,
              const Eigen::Vector2f& viewpoint, std::span<float> columns);

}  // namespace columns
