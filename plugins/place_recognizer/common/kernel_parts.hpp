// SPDX-License-Identifier: BSD-3-Clause
// What all kernels share, inlined into each and so compiled for its instruction set.
#pragma once
#include <algorithm>
#include <bit>
#include <cstring>

#include "common/kernel.hpp"

namespace columns {

/// As many lanes as a kernel works on at once; the compiler splits it where registers are shorter.
template <std::size_t width>
using Floats [[gnu::vector_size(width * sizeof(float))]] = float;

/// Of descriptors with 20 rings.
constexpr std::size_t usual_groups = 10;

template <class T>
[[gnu::always_inline]] inline void load(T& to, const void* from) {
  std::memcpy(&to, from, sizeof(T));
}

/// Lanes whose largest sum, at most `sums`, allows for a distance that is tolerated:
/// 1 - S / n <= d means S >= (1 - d) n, and both have filled n >= a + b - sectors columns.
/// Registers::not_negative(x) has a bit for each of x[lanes] that is not below 0.
template <class Registers>
[[gnu::always_inline]] inline unsigned possible(Shape shape, const std::byte* tile,
                                                const Screening& screening, const float* sums) {
  const TileLayout layout(shape);
  const CoarseQuery& query = *screening.query;
  float error[lanes], norm[lanes], filled[lanes], margin[lanes];
  load(error, tile + layout.error);
  load(norm, tile + layout.norm);
  load(filled, tile + layout.filled);
  const float more = float(query.filled - shape.sectors), least = screening.least_columns;
  const float wanted = 1.0f - screening.tolerated - 1e-5f;
  if (float(query.filled) < least) return 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const float common = std::max(filled[lane] + more, least);
    const float reachable =
        sums[lane] + query.per_error * error[lane] + query.per_norm * norm[lane];
    margin[lane] = filled[lane] >= least ? reachable - wanted * common : -1.0f;
  }
  return Registers::not_negative(margin);
}

/// The lane has a shift whose sum allows for a distance that is tolerated.
[[gnu::always_inline]] inline bool has_shift(Shape shape, const std::byte* tile,
                                             const Screening& screening, const float* sums,
                                             std::size_t lane) {
  const TileLayout layout(shape);
  const CoarseQuery& query = *screening.query;
  const std::size_t words = shape.words();
  std::uint64_t mask[most_words];
  std::memcpy(mask, tile + layout.masks + lane * words * 8, words * 8);
  const float error = query.per_error * read<float>(tile + layout.error, lane) +
                      query.per_norm * read<float>(tile + layout.norm, lane);
  const float wanted = 1.0f - screening.tolerated - 1e-5f;
  const std::uint64_t* shifted = query.overlap.shifted();
  bool found = false;
  for (std::size_t k = 0; k < std::size_t(shape.sectors); ++k, shifted += words) {
    int n = 0;
    for (std::size_t w = 0; w < words; ++w) n += std::popcount(shifted[w] & mask[w]);
    found |= (float(n) >= screening.least_columns) &
             (sums[k * lanes + lane] + error >= wanted * float(n));
  }
  return found;
}

/// Sums over every `stride`-th frequency from `parity` on, for four shifts from `first` on.
template <class Part>
struct FourShifts {
  Part cosines[4] = {}, sines[4] = {};
};
template <class Part>
[[gnu::always_inline]] inline void add_frequencies(const InverseTransform& inverse,
                                                   const float* cross, std::size_t first,
                                                   std::size_t parity, std::size_t stride,
                                                   FourShifts<Part>& to) {
  const std::size_t F = inverse.shape.frequencies();
  const float* cosine = inverse.cosine.data() + first * F;
  const float* sine = inverse.sine.data() + first * F;
  for (std::size_t f = parity; f < F; f += stride) {
    Part real, imaginary;
    load(real, cross + 2 * f * lanes);
    load(imaginary, cross + (2 * f + 1) * lanes);
    for (std::size_t j = 0; j < 4; ++j) {
      to.cosines[j] += real * cosine[j * F + f];
      to.sines[j] += imaginary * sine[j * F + f];
    }
  }
}

/// S(k) and S(-k), from the sum of Re cos and that of Im sin.
template <class Part>
[[gnu::always_inline]] inline void write_pair(const Part& cosines, const Part& sines, std::size_t k,
                                              std::size_t sectors, float* sums, Part& largest) {
  const Part ahead = cosines - sines, behind = cosines + sines;
  const Part larger = ahead > behind ? ahead : behind;
  largest = larger > largest ? larger : largest;
  std::memcpy(sums + k * lanes, &ahead, sizeof(Part));
  std::memcpy(sums + (sectors - k) % sectors * lanes, &behind, sizeof(Part));
}

/// All S(k), and the largest of each lane. k and -k share their products; so do k and
/// sectors / 2 - k where that is whole, up to the sign of every second frequency.
template <class Part>
[[gnu::always_inline]] inline void all_shifts(const InverseTransform& inverse, const float* cross,
                                              float* sums, Part& largest) {
  const auto sectors = std::size_t(inverse.shape.sectors);
  const bool folds = sectors % 2 == 0;
  const std::size_t last = folds ? sectors / 4 : sectors / 2;
  for (std::size_t first = 0; first <= last; first += 4) {
    FourShifts<Part> even, odd;
    add_frequencies(inverse, cross, first, 0, folds ? 2 : 1, even);
    if (folds) add_frequencies(inverse, cross, first, 1, 2, odd);
    for (std::size_t j = 0; j < 4 && first + j <= last; ++j) {
      const std::size_t k = first + j;
      write_pair<Part>(even.cosines[j] + odd.cosines[j], even.sines[j] + odd.sines[j], k, sectors,
                       sums, largest);
      if (folds)
        write_pair<Part>(even.cosines[j] - odd.cosines[j], odd.sines[j] - even.sines[j],
                         sectors / 2 - k, sectors, sums, largest);
    }
  }
}

template <class Registers>
[[gnu::always_inline]] inline unsigned weigh_lanes(const InverseTransform& inverse,
                                                   const std::byte* tile, const Screening& screened,
                                                   float* sums) {
  constexpr std::size_t width = Registers::width;
  const Shape shape = inverse.shape;
  float largest[lanes];
  for (std::size_t lane = 0; lane < lanes; lane += width) {
    Floats<width> of_part = {};
    all_shifts(inverse, screened.cross + lane, sums + lane, of_part);
    std::memcpy(largest + lane, &of_part, sizeof of_part);
  }
  unsigned good = screened.possible & possible<Registers>(shape, tile, screened, largest);
  if (screened.query->filled == shape.sectors)
    return good;  // the references' own columns count, all of them
  for (unsigned left = good; left != 0; left &= left - 1) {
    const auto lane = std::size_t(std::countr_zero(left));
    if (!has_shift(shape, tile, screened, sums, lane)) good &= ~(1u << lane);
  }
  return good;
}

[[gnu::always_inline]] inline float dot_product(const float* a, const float* b, std::size_t count) {
  constexpr std::size_t width = 16;
  Floats<width> sums = {};
  std::size_t i = 0;
  for (; i + width <= count; i += width) {
    Floats<width> x, y;
    load(x, a + i);
    load(y, b + i);
    sums += x * y;
  }
  float sum = 0;
  for (std::size_t lane = 0; lane < width; ++lane) sum += sums[lane];
  for (; i < count; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace columns
