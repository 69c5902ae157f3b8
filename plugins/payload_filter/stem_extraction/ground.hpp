// SPDX-License-Identifier: BSD-3-Clause
// The height of the ground under the trees.
#pragma once
#include <vector>

#include "cambium/payload.hpp"

namespace stem_extraction {

struct GroundLimits {
  double cell = 1.0;        ///< of the grid [m]
  double max_slope = 0.52;  ///< steeper is no ground: 30 degrees [rad]
};

/// The lowest points of each cell of a grid, without those that lie below or, measured by the slope
/// to a lower one, above the ground (Vosselman, "Slope based filtering of laser altimetry data",
/// ISPRS 2000); local planes through them, by reweighted least squares.
class Ground {
 public:
  /// `points` with z up, within `range` of the origin in x and y [m].
  Ground(const std::vector<Eigen::Vector3f>& points, double range, const GroundLimits& limits);

  /// Interpolated between the nodes of the grid; NaN where nothing is known of the ground.
  float height(float x, float y) const;
  double range() const { return range_; }

 private:
  int index(int ix, int iy) const { return iy * width_ + ix; }
  int cell_of(const Eigen::Vector3f& p) const;  ///< -1 outside
  template <class Visit>
  void around(int ix, int iy, int reach, Visit visit) const;
  void take_lowest(const std::vector<Eigen::Vector3f>& points);
  void drop_low_outliers();
  void drop_what_stands_on_the_ground();
  float plane_at(float x, float y) const;

  GroundLimits limits_;
  double range_;
  int width_;                            ///< cells along an axis
  std::vector<Eigen::Vector3f> lowest_;  ///< mean, of each cell; z is NaN where there is none
  std::vector<float> heights_;           ///< at the corners of the cells, (width + 1)^2
};

}  // namespace stem_extraction
