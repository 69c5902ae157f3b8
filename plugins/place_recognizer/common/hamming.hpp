// SPDX-License-Identifier: BSD-3-Clause
// Descriptors of 256 bits, as ORB makes them, and how many of these differ.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace columns {

using Bits = std::array<std::uint64_t, 4>;

struct NearestBits {
  std::size_t index = 0;
  int distance = 257;  ///< bits that differ; 257: there was nothing to compare with
};

/// For each of `a` the nearest of `b`, and the other way. Of two that are as near the first counts.
std::pair<std::vector<NearestBits>, std::vector<NearestBits>> nearest_bits(std::span<const Bits> a,
                                                                           std::span<const Bits> b);

}  // namespace columns
