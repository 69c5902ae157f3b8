// SPDX-License-Identifier: BSD-3-Clause
#include "common/voxel_set.hpp"

#include <cmath>

namespace cambium::map_export {
namespace {

constexpr std::int64_t half_range = 1 << 24;  // voxels from the origin; 21 bits hold their blocks

}  // namespace

bool VoxelSet::in_range(const Vec3& point) const {
  // Also false for a point that is not finite.
  return point.cwiseAbs().maxCoeff() < voxel_size_ * double(half_range - 1) && point.allFinite();
}

bool VoxelSet::insert(const Vec3& point) {
  constexpr std::int64_t mask = (1 << block_bits) - 1;
  std::uint64_t block = 0;
  std::size_t voxel = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto index = std::int64_t(std::floor(point[axis] / voxel_size_)) + half_range;
    block = block << 21 | std::uint64_t(index >> block_bits);
    voxel = voxel << block_bits | std::size_t(index & mask);
  }
  auto& taken = blocks_[block];
  const bool is_new = !taken.test(voxel);
  taken.set(voxel);
  return is_new;
}

}  // namespace cambium::map_export
