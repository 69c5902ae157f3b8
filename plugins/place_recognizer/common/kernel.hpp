// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the search: a query against the references of a tile. Each is there
// once for every instruction set and the right one is chosen where the program runs. They round
// differently; the search only relies on the bounds that they keep.
#pragma once
#include <span>

#include "common/coarse_query.hpp"
#include "common/tiles.hpp"

namespace columns {

/// What screen() must know besides query and tile.
struct Screening {
  float tolerated = 1.0f;  ///< pairs of a larger distance are of no interest
  float least_columns = 1.0f;
  bool fetch_ahead = false;  ///< read on into the next tile: the loops wait for memory otherwise
};

struct Kernel {
  const char* name;
  /// One bit a lane: the distance may be at most `tolerated`. Since |S(k)| <= sum of |cross(f)|,
  /// no shift is looked at. Leaves the cross spectra in cross[frequencies][2][lanes].
  unsigned (*screen)(Shape shape, const std::byte* tile, const CoarseQuery& query,
                     const Screening& screening, float* cross);
  /// The same shift by shift, of the lanes in `possible`. Leaves S(k), up to the query's error
  /// bound, in sums[sectors][lanes].
  unsigned (*weigh)(const InverseTransform& inverse, const std::byte* tile,
                    const CoarseQuery& query, const Screening& screening, const float* cross,
                    unsigned possible, float* sums);
  /// Dot product in float, off by at most rounding_of_dot(count) times the sum of |a b|.
  float (*dot)(const float* a, const float* b, std::size_t count);
};

inline double rounding_of_dot(std::size_t count) { return (double(count) / 16.0 + 32.0) * 0x1p-23; }

/// Those that this processor can run, the fastest first. The last one needs nothing special.
std::span<const Kernel> kernels();

}  // namespace columns
