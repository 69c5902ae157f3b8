// SPDX-License-Identifier: BSD-3-Clause
// The best references of every query, over all pairs and all column shifts: the same as by going
// through all of them with the definition (distance.hpp), and in a fraction of the time.
#pragma once
#include <vector>

#include "cambium/kinds.hpp"
#include "common/kernel.hpp"

namespace columns {

/// Where descriptors lie in fingerprints: row i holds `views` of them, from column `first` on. The
/// first view also lies in tiles, in the tile_bytes() of `extra` from `first_tile` on.
struct Table {
  const cambium::Fingerprints& fingerprints;
  Shape shape;
  std::size_t views = 1, first = 0, first_tile = 0;

  std::size_t size() const { return fingerprints.rows; }
  std::span<const float> descriptor(std::size_t node, std::size_t view) const {
    return fingerprints.row(node).subspan(first + view * shape.bins(), shape.bins());
  }
  const std::byte* tile(std::size_t i) const {
    return fingerprints.extra.data() + first_tile + tiles_begin + i * TileLayout(shape).bytes;
  }
};

/// The bytes of all tiles of a table, and their contents (to be called by describe()).
std::size_t tile_bytes(std::size_t nodes, Shape shape);
void encode_tiles(cambium::Fingerprints& fingerprints, const Table& table,
                  const cambium::Context& context);

struct Limits {
  int candidates = 10;        ///< at most so many references for a query
  double threshold = 0.4;     ///< largest distance
  double min_overlap = 0.25;  ///< share of the sectors that must be filled in both
};

/// A pair at its best shift.
struct Match {
  std::size_t reference = 0;
  std::size_t view = 0;   ///< of the query
  double distance = 1.0;  ///< 0..1
  double shift = 0.0;     ///< of the columns, refined between them, -sectors/2..sectors/2
};

/// For each query its matches, best first; of equal ones the lower reference, view, shift is first.
std::vector<std::vector<Match>> search(const Table& queries, const Table& references,
                                       const cambium::Pairing& pairing, const Limits& limits,
                                       const cambium::Context& context,
                                       const Kernel& kernel = kernels().front());

}  // namespace columns
