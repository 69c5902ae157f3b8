// SPDX-License-Identifier: BSD-3-Clause
#include "common/hamming.hpp"

#include <bit>

namespace columns {
namespace {

// Compiled twice: a library that runs on any x86-64 may not take the instruction for granted, and
// without it this takes six times as long.
[[gnu::always_inline]] inline void compare(std::span<const Bits> a, std::span<const Bits> b,
                                           NearestBits* of_a, NearestBits* of_b) {
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < b.size(); ++k) {
      const int distance = std::popcount(a[i][0] ^ b[k][0]) + std::popcount(a[i][1] ^ b[k][1]) +
                           std::popcount(a[i][2] ^ b[k][2]) + std::popcount(a[i][3] ^ b[k][3]);
      if (distance < of_a[i].distance) of_a[i] = {k, distance};
      if (distance < of_b[k].distance) of_b[k] = {i, distance};
    }
}

void compare_portable(std::span<const Bits> a, std::span<const Bits> b, NearestBits* of_a,
                      NearestBits* of_b) {
  compare(a, b, of_a, of_b);
}

#if defined(__x86_64__) && defined(__GNUC__)
[[gnu::target("popcnt")]] void compare_popcnt(std::span<const Bits> a, std::span<const Bits> b,
                                              NearestBits* of_a, NearestBits* of_b) {
  compare(a, b, of_a, of_b);
}
const auto fastest = __builtin_cpu_supports("popcnt") ? compare_popcnt : compare_portable;
#else
const auto fastest = compare_portable;
#endif

}  // namespace

std::pair<std::vector<NearestBits>, std::vector<NearestBits>> nearest_bits(
    std::span<const Bits> a, std::span<const Bits> b) {
  std::pair out{std::vector<NearestBits>(a.size()), std::vector<NearestBits>(b.size())};
  fastest(a, b, out.first.data(), out.second.data());
  return out;
}

}  // namespace columns
