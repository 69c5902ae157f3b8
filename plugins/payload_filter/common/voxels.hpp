// SPDX-License-Identifier: BSD-3-Clause
// Voxels of a grid through the origin, and the means of what lies in them.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "cambium/payload.hpp"

namespace cambium::filter {

/// x, y and z of a voxel, 21 bits each: sorted, they come in the order of x, y, z. Nothing for a
/// point that is not finite or more than 2^20 voxels away from the origin.
std::optional<std::uint64_t> voxel_of(const Eigen::Vector3f& point, double size);

struct PointInVoxel {
  std::uint64_t voxel;
  std::uint32_t point;
  bool operator<(const PointInVoxel& o) const {
    return voxel != o.voxel ? voxel < o.voxel : point < o.point;
  }
};

/// The points that have a voxel, by voxel and then by their number.
std::vector<PointInVoxel> sorted_by_voxel(const Cloud& cloud, double size);

/// Adds up clouds voxel by voxel. Memory is that of the occupied voxels, however many clouds come.
/// Sums of floats in double are exact as long as their exponents are alike, so the means do not
/// depend on the order of the points.
class VoxelMeans {
 public:
  explicit VoxelMeans(double size) : size_(size) {}

  /// Returns how many points have no voxel.
  std::size_t add(const Cloud& cloud);
  /// Mean position, direction of the mean normal and mean intensity of every voxel with at least
  /// `min_points`, in the order of x, y, z. Normals, intensities and labels only if every cloud with
  /// a point had them. Points of several labels make one of none.
  Cloud means(int min_points = 1) const;

 private:
  struct Sum {
    std::uint64_t voxel = 0;
    double count = 0;
    Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
    Eigen::Vector3f first_normal = Eigen::Vector3f::Zero();
    double intensity = 0;
    std::uint8_t label = 0;
  };
  std::vector<Sum> sums_of(const Cloud& cloud, const std::vector<PointInVoxel>& points) const;
  static void merge(Sum& into, const Sum& other);

  double size_;
  bool normals_ = true, intensity_ = true, label_ = true;
  std::vector<Sum> sums_;  ///< by voxel
};

}  // namespace cambium::filter
