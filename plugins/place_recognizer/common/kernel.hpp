// SPDX-License-Identifier: BSD-3-Clause
// The inner loops of the search: a query against the references of a tile. Each is there
// once for every instruction set and the right one is chosen where the program runs. They round
// differently; the search only relies on the bounds that they keep.
#pragma once
#include <span>

#include "common/coarse_query.hpp"
#include "common/tiles.hpp"

namespace columns {

/// A query against a tile: what is asked, and what came out of it.
struct Screening {
  const CoarseQuery* query = nullptr;
  float tolerated = 1.0f;  ///< pairs of a larger distance are of no interest
  float least_columns = 1.0f;
  float* cross = nullptr;  ///< [frequencies][2][lanes]: where the cross spectra go
  unsigned possible = 0;   ///< the answer, one bit a lane: the distance may be at most `tolerated`
};

struct Kernel {
  const char* name;
  /// Answers all of `queries`, and fills their cross spectra. Since |S(k)| <= sum of |cross(f)|, no
  /// shift is looked at. `fetch_ahead`: reads on into the next tile, the loops wait for memory
  /// otherwise.
  void (*screen)(Shape shape, const std::byte* tile, std::span<Screening> queries,
                 bool fetch_ahead);
  /// The same shift by shift, of the lanes that are possible. Leaves S(k), up to the query's error
  /// bound, in sums[sectors][lanes].
  unsigned (*weigh)(const InverseTransform& inverse, const std::byte* tile,
                    const Screening& screened, float* sums);
  /// Dot product in float, off by at most rounding_of_dot(count) times the sum of |a b|.
  float (*dot)(const float* a, const float* b, std::size_t count);
};

inline double rounding_of_dot(std::size_t count) { return (double(count) / 16.0 + 32.0) * 0x1p-23; }

/// Those that this processor can run, the fastest first. The last one needs nothing special.
std::span<const Kernel> kernels();

}  // namespace columns
