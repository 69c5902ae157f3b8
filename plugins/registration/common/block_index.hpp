// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/thin.hpp"

namespace cambium::registration {

struct Nearest {
  std::int32_t index = -1;  ///< -1: no point within the radius
  float squared = 0;        ///< distance to it, squared; without one the radius, squared [m^2]
  float others = 0;         ///< no other point is nearer than this, squared [m^2]
};

/// Finds nearest points of a thinned cloud, exactly: blocks of voxels in a hash table, and in each
/// its points one behind the other. A surface crosses a block with some 15 points and a match is
/// much nearer than the block is wide, so a search looks at one or two blocks.
class BlockIndex {
 public:
  BlockIndex() = default;
  explicit BlockIndex(const Thinned& cloud);
  /// Of the points nearer than `radius` [m]. The query must be finite.
  /// `others` of the answer is exact up to `margin` beyond the nearest point's distance.
  Nearest nearest(const Eigen::Vector3f& query, float radius, float margin) const;
  /// The block next to `block`, 0..2 along each axis, 1 = the same; -1 when it is empty.
  std::int32_t around(std::size_t block, int x, int y, int z) const {
    return around_[block][std::size_t(9 * x + 3 * y + z)];
  }
  std::size_t bytes() const {
    return slots_.size() * 4 + places_.size() * 124 + 3 * x_.size() * sizeof(float);
  }

 private:
  std::int32_t find(const Eigen::Array3i& place) const {
    for (std::uint32_t slot = hash(place) & mask_;; slot = (slot + 1) & mask_) {
      const std::int32_t block = slots_[slot];
      if (block < 0 || (places_[std::size_t(block)] == place).all()) return block;
    }
  }

  static std::uint32_t hash(const Eigen::Array3i& p) {
    const std::uint32_t h = std::uint32_t(p.x()) * 73856093U ^ std::uint32_t(p.y()) * 19349663U ^
                            std::uint32_t(p.z()) * 83492791U;
    return h ^ h >> 15;
  }
  struct Search;
  void scan(std::int32_t block, Search& search) const;
  void scan_shell(int shell, Search& search) const;

  float width_ = 1;  ///< of a block [m]
  std::uint32_t mask_ = 0;
  std::vector<std::int32_t> slots_ = {-1};  ///< block numbers, -1 = free
  std::vector<Eigen::Array3i> places_;
  std::vector<std::uint32_t> first_;
  std::vector<std::array<std::int32_t, 27>> around_;
  std::vector<float> x_, y_, z_;
};

}  // namespace cambium::registration
