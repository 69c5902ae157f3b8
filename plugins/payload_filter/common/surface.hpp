// SPDX-License-Identifier: BSD-3-Clause
// How the points around each point lie: principal axes of their covariance.
#pragma once
#include <vector>

#include "common/voxels.hpp"

namespace cambium::filter {

/// Of a neighbourhood. The axes are those of the covariance of its points, with the variances
/// l0 <= l1 <= l2 (Weinmann et al., "Semantic point cloud interpretation based on optimal
/// neighborhoods, relevant features and efficient classifiers", ISPRS J. 2015).
struct Shape {
  int points = 0;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();     ///< axis of l0, unit length
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();  ///< axis of l2, unit length
  float variation = 0;                                  ///< l0 / (l0 + l1 + l2): 0 flat, 1/3 a ball
  float linearity = 0;                                  ///< (l2 - l1) / l2: 1 a line
};

/// The shape around every point. Points in a cell of radius / 2 share one neighbourhood: all cells
/// whose mean lies within `radius` [m] of the mean of their own. So the time is that of the
/// occupied cells, not of the pairs of points. Coordinates should be below 10 km (sums of squares
/// in double).
class Shapes {
 public:
  Shapes(const Cloud& cloud, double radius);
  /// No points for one that is not finite or too far away for the grid.
  const Shape& operator[](std::size_t point) const { return shapes_[cell_of_[point]]; }

 private:
  std::vector<std::uint32_t> cell_of_;  ///< of each point; the last shape is that of none
  std::vector<Shape> shapes_;           ///< of each occupied cell
};

}  // namespace cambium::filter
