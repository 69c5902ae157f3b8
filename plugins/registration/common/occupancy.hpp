// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "common/surface.hpp"

namespace cambium::registration {

/// The points whose surface stands up (walls, stems), 3 x n. Level ground matches itself wherever
/// one puts it and would hide the horizontal offset.
Eigen::Matrix3Xf upright(const Surface& surface);

/// A grid that remembers where points are: 2 in their cells, 1 in the cells around.
class Occupancy {
 public:
  Occupancy(const Eigen::Matrix3Xf& points, float cell);
  /// Sum over the points, moved by `offset`.
  int score(const Eigen::Matrix3Xf& points, const Eigen::Vector3f& offset) const;

 private:
  void mark(const Eigen::Array3i& centre);

  float cell_;
  Eigen::Vector3f origin_;
  Eigen::Array3i size_;
  std::vector<std::uint8_t> values_;
};

}  // namespace cambium::registration
