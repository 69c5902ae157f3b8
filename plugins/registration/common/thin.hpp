// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "cambium/payload.hpp"

namespace cambium::registration {

/// One point per occupied voxel, ordered by block of 4 x 4 x 4 voxels and by voxel within it.
struct Thinned {
  double voxel_size = 0;                ///< [m]
  std::vector<Eigen::Vector3f> points;  ///< mean of the voxel's points [m]
  std::vector<std::uint8_t> voxel;      ///< its place in the block, 0..63: 16 x + 4 y + z
  std::vector<std::size_t> first;       ///< of each block in `points`, and an end
  std::vector<Eigen::Array3i> blocks;   ///< their places, in blocks from the frame's origin
};

/// Points that are not finite are left out: drivers write them for "no return"; so are those
/// farther than 2^20 voxels, which no lidar sees. The order of the cloud matters to rounding only.
Thinned thin(const Cloud& cloud, double voxel_size);
/// The same from points that were thinned already, to a larger voxel; each counts once.
Thinned thin(const std::vector<Eigen::Vector3f>& points, double voxel_size);

}  // namespace cambium::registration
