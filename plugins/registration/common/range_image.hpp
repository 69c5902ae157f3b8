// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "cambium/payload.hpp"
#include "cambium/se3.hpp"
#include "common/surface.hpp"

namespace cambium::registration {

/// How far a sensor at the origin sees in each direction: the nearest point in each of 6 x 48 x 48
/// squares of a cube (about 2 degrees each).
class RangeImage {
 public:
  explicit RangeImage(const Cloud& cloud);
  /// [m]; 0 where the square has no point.
  float range(const Eigen::Vector3f& direction) const { return ranges_[square(direction)]; }
  std::size_t bytes() const { return ranges_.size() * sizeof(float); }

 private:
  static constexpr int width = 48;
  static std::size_t square(const Eigen::Vector3f& direction);
  std::vector<float> ranges_;
};

/// What one scan says about the standing surfaces of another.
struct Sight {
  std::size_t confirmed = 0;     ///< the rays end at them
  std::size_t seen_through = 0;  ///< the rays pass where they would be
  Sight& operator+=(const Sight& other) {
    confirmed += other.confirmed;
    seen_through += other.seen_through;
    return *this;
  }
  double share() const {
    const std::size_t all = confirmed + seen_through;
    return all == 0 ? 0 : double(seen_through) / double(all);
  }
};

/// Surfaces behind others are not counted. The ground is not, either: rays graze it.
Sight look(const RangeImage& target, const Patches& source, const SE3& T_target_source);

}  // namespace cambium::registration
