// SPDX-License-Identifier: BSD-3-Clause
// A point on its way into a tile.
#pragma once
#include <cstdint>
#include <optional>

#include "cambium/se3.hpp"

namespace web_view {

constexpr double units_per_metre = 1024;  ///< positions are whole numbers of 1/1024 m, about 1 mm
constexpr int position_bits = 30;         ///< so the map reaches 524 km from its origin

struct Point {
  std::int32_t x = 0, y = 0, z = 0;  ///< map frame, in units
  std::uint32_t node = 0;            ///< over all missions, in the order of the atlas
  float intensity = 0;               ///< as the cloud has it; 0 where it has none
  std::uint32_t label = 0;           ///< as the cloud has it; 0 where it has none
};

/// Nothing when the point is not finite or out of reach.
std::optional<Point> quantised(const cambium::Vec3& p_map);

/// The same well-mixed number for the same point in every run (the finaliser of SplitMix64).
std::uint64_t mixed(std::uint64_t value);

}  // namespace web_view
