// SPDX-License-Identifier: BSD-3-Clause
#include "common/kernel_portable.hpp"

#include <cmath>

#include "common/kernel_parts.hpp"

namespace columns {
namespace {

struct Registers {
  static constexpr std::size_t width = 16;
  static unsigned not_negative(const float* x) {
    unsigned bits = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) bits |= unsigned(!(x[lane] < 0)) << lane;
    return bits;
  }
};

using Sums = std::int32_t[lanes];

void multiply(const std::uint8_t* codes, const std::int8_t* real, const std::int8_t* imaginary,
              std::size_t groups, Sums& re, Sums& im) {
  for (std::size_t g = 0; g < groups; ++g, codes += 4 * lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane)
      for (std::size_t i = 0; i < 4; ++i) {
        re[lane] += std::int32_t(codes[4 * lane + i]) * real[4 * g + i];
        im[lane] += std::int32_t(codes[4 * lane + i]) * imaginary[4 * g + i];
      }
}

void screen_one(Shape shape, const std::byte* tile, Screening& screening) {
  const TileLayout layout(shape);
  const CoarseQuery& query = *screening.query;
  const std::size_t width = 4 * shape.groups();
  float sums[lanes] = {};
  for (std::size_t f = 0; f < shape.frequencies(); ++f) {
    Sums re, im;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      re[lane] = query.offsets[2 * f], im[lane] = query.offsets[2 * f + 1];
    const std::int8_t* codes = query.codes.data() + 2 * f * width;
    multiply(reinterpret_cast<const std::uint8_t*>(tile) + f * width * lanes, codes, codes + width,
             shape.groups(), re, im);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto half = read<std::uint16_t>(tile + layout.scales, f * lanes + lane);
      const float scale = query.gains[f] * std::bit_cast<float>(std::uint32_t(half) << 16);
      const float x = scale * float(re[lane]), y = scale * float(im[lane]);
      screening.cross[2 * f * lanes + lane] = x;
      screening.cross[(2 * f + 1) * lanes + lane] = y;
      sums[lane] += std::sqrt(x * x + y * y);
    }
  }
  screening.possible = possible<Registers>(shape, tile, screening, sums);
}

void screen(Shape shape, const std::byte* tile, std::span<Screening> queries, bool) {
  for (Screening& query : queries) screen_one(shape, tile, query);
}

unsigned weigh(const InverseTransform& inverse, const std::byte* tile, const Screening& screened,
               float* sums) {
  return weigh_lanes<Registers>(inverse, tile, screened, sums);
}

float dot(const float* a, const float* b, std::size_t count) { return dot_product(a, b, count); }

}  // namespace

const Kernel portable_kernel = {"portable", screen, weigh, dot};

}  // namespace columns
