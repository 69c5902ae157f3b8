// SPDX-License-Identifier: BSD-3-Clause
// Which voxels of a map are taken, in about 3 bytes a voxel of a surface.
#pragma once
#include <bitset>
#include <cstdint>
#include <unordered_map>

#include "cambium/se3.hpp"

namespace cambium::map_export {

/// Blocks of 16^3 voxels, one bit each. A hash set of voxels would need ten times the memory.
class VoxelSet {
 public:
  explicit VoxelSet(double voxel_size) : voxel_size_(voxel_size) {}

  /// True when no earlier point fell into this point's voxel. The point must be finite and less
  /// than 2^24 voxels from the origin.
  bool insert(const Vec3& point);
  bool in_range(const Vec3& point) const;

 private:
  static constexpr int block_bits = 4;  // 16 voxels a side
  double voxel_size_;
  std::unordered_map<std::uint64_t, std::bitset<1 << (3 * block_bits)>> blocks_;
};

}  // namespace cambium::map_export
