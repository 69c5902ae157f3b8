// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/surface.hpp"

namespace cambium::registration {

/// The points whose surface stands up (walls, stems), 3 x n. Those without a normal are left out.
/// Level ground matches itself wherever one puts it and would hide the horizontal offset.
Eigen::Matrix3Xf upright(const Patches& patches);

/// A grid that remembers where points are: 2 in their cells, 1 in the cells around. Scores how
/// well other points fit when they are shifted by whole cells, at most `reach` of them.
class Occupancy {
 public:
  Occupancy(const Eigen::Matrix3Xf& points, float cell, const Eigen::Array3i& reach);
  /// Where the points fall, as places in the grid; those that no shift brings near are left out.
  std::vector<std::int32_t> places(const Eigen::Matrix3Xf& points) const;
  /// Sum of the values under the places, shifted.
  int score(const std::vector<std::int32_t>& places, const Eigen::Array3i& shift) const;

 private:
  std::int32_t place(const Eigen::Array3i& c) const {
    return (c.z() * size_.y() + c.y()) * size_.x() + c.x();
  }
  Eigen::Array3i cell_of(const Eigen::Vector3f& p) const {
    return ((p - origin_) / cell_).array().floor().cast<int>();
  }
  void mark(const Eigen::Array3i& centre);

  float cell_;
  Eigen::Array3i reach_, size_;
  Eigen::Vector3f origin_;  ///< corner of cell (0, 0, 0)
  std::vector<std::uint8_t> values_;
};

}  // namespace cambium::registration
