// SPDX-License-Identifier: BSD-3-Clause
#include "common/search.hpp"

#include <algorithm>

#include "common/query_search.hpp"

namespace columns {
namespace {

// A tile is read once for so many descriptors of queries. More gain little, and leave the threads
// of a small mission without work.
constexpr std::size_t descriptors_at_once = 16;

constexpr std::size_t tiles_between_checks = 256;

void look_at(std::size_t tile, const Task& task, std::span<QuerySearch> searches,
             Scratch& scratch) {
  scratch.screenings.clear();
  for (QuerySearch& search : searches) search.ask(tile, scratch);
  const bool fetch_ahead = tile + 1 < tile_count(task.references.size());
  task.kernel.screen(task.references.shape, task.references.tile(tile), scratch.screenings,
                     fetch_ahead);
  std::span<Screening> answers = scratch.screenings;
  for (QuerySearch& search : searches) search.look_at(tile, answers, scratch.sums);
}

}  // namespace

std::size_t tile_bytes(std::size_t nodes, Shape shape) {
  return tiles_begin + tile_count(nodes) * TileLayout(shape).bytes + tiles_end;
}

void encode_tiles(cambium::Fingerprints& fingerprints, const Table& table,
                  const cambium::Context& context) {
  const Transform transform(table.shape);
  const std::size_t bytes = TileLayout(table.shape).bytes;
  context.parallel_for(tile_count(table.size()), [&](std::size_t i) {
    std::vector<std::span<const float>> descriptors;
    for (std::size_t n = i * lanes; n < std::min((i + 1) * lanes, table.size()); ++n)
      descriptors.push_back(table.descriptor(n, 0));
    encode_tile(descriptors, transform,
                {fingerprints.extra.data() + (table.tile(i) - fingerprints.extra.data()), bytes});
  });
}

std::vector<std::vector<Match>> search(const Table& queries, const Table& references,
                                       const cambium::Pairing& pairing, const Limits& limits,
                                       const cambium::Context& context, const Kernel& kernel) {
  const Transform transform(references.shape);
  const Task task{references, pairing, limits, kernel, InverseTransform(references.shape)};
  const std::size_t at_once = std::max<std::size_t>(1, descriptors_at_once / queries.views);
  std::vector<std::vector<Match>> matches(queries.size());
  context.parallel_for((queries.size() + at_once - 1) / at_once, [&](std::size_t block) {
    const std::size_t end = std::min((block + 1) * at_once, queries.size());
    std::vector<QuerySearch> searches;
    for (std::size_t q = block * at_once; q < end; ++q)
      searches.emplace_back(task, queries, q, transform);
    Scratch scratch(references.shape, searches.size() * queries.views);
    for (std::size_t tile = 0; tile < tile_count(references.size()); ++tile) {
      if (tile % tiles_between_checks == 0) context.check_cancelled();
      look_at(tile, task, searches, scratch);
    }
    for (std::size_t q = block * at_once; q < end; ++q)
      matches[q] = searches[q - block * at_once].matches();
  });
  return matches;
}

}  // namespace columns
