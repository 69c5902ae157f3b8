// SPDX-License-Identifier: BSD-3-Clause
// Descriptors that are a circle of columns, and the distance that all of common/ is about.
//
// A column is a unit vector of `rings` floats, or zero where nothing was seen. With n(k) columns
// that both have filled when the reference is turned by k columns, the distance of a pair is
//   d = min over k of d(k),  d(k) = max(0, 1 - S(k) / n(k)),
//   S(k) = sum over s of <query column s, reference column s + k>
// (Kim & Kim, IROS 2018, equations 6 and 7). Shifts with too few columns in common do not count.
#pragma once
#include <cstddef>

namespace columns {

struct Shape {
  int rings = 20, sectors = 60;
  std::size_t bins() const { return std::size_t(rings) * std::size_t(sectors); }
  /// Of the Fourier transform over the sectors; the others mirror these.
  std::size_t frequencies() const { return std::size_t(sectors) / 2 + 1; }
  /// Real and imaginary parts of one frequency fill so many groups of four bytes.
  std::size_t groups() const { return (2 * std::size_t(rings) + 3) / 4; }
  /// 64-bit words of a bit for each sector.
  std::size_t words() const { return (std::size_t(sectors) + 63) / 64; }
};

constexpr int most_sectors = 720;
constexpr std::size_t most_words = (most_sectors + 63) / 64;

}  // namespace columns
