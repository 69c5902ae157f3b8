// SPDX-License-Identifier: BSD-3-Clause
// The scan context of one cloud: the highest point in every bin of a polar grid around the base.
// G. Kim, A. Kim, "Scan Context: Egocentric Spatial Descriptor for Place Recognition within 3D
// Point Cloud Map", IROS 2018, sections III-A and III-B.
#pragma once
#include <span>
#include <vector>

#include "cambium/payload.hpp"

namespace scan_context {

struct Grid {
  int rings = 20, sectors = 60;
  double max_range = 80.0;     ///< horizontal radius of the outermost ring [m]
  double height_offset = 2.0;  ///< added to heights, so that the ground counts too [m]
  std::size_t bins() const { return std::size_t(rings) * std::size_t(sectors); }
};

/// The smallest rotation that sets the base upright: p_level = q_level_base * p_base. It does not
/// depend on the heading. T_mission_node's frame has z against gravity.
cambium::Quat level_rotation(const cambium::SE3& T_mission_node);

/// The finite points of the cloud in the levelled frame.
cambium::Cloud::Matrix3X levelled(const cambium::Cloud& cloud, const cambium::Quat& q_level_base);

/// Horizontal offsets of viewpoints from the base [m]: a square grid of `step` within `radius`, the
/// base itself first. A radius below the step gives the base alone.
std::vector<Eigen::Vector2f> viewpoints(double radius, double step);

/// Writes the descriptor of levelled points, as seen from `viewpoint`, to `columns`: sector by
/// sector, each column of `rings` heights scaled to unit length, so that the dot product of two
/// columns is the cosine of the paper's equation (6). A column without points is zero. Points
/// beyond max_range or lower than -height_offset count as not seen.
void describe(const cambium::Cloud::Matrix3X& points, const Grid& grid,
              const Eigen::Vector2f& viewpoint, std::span<float> columns);

}  // namespace scan_context
