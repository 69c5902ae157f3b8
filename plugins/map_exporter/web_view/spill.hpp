// SPDX-License-Identifier: BSD-3-Clause
// Points of a map on disk, by the chunk of space that they lie in: memory stays bounded however
// large the map is.
#pragma once
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "point.hpp"

namespace web_view {

constexpr int chunk_bits = 14;  ///< chunks are 2^14 units wide: 16 m

/// A chunk by its place: x, y, z in chunk widths from the origin.
using ChunkKey = std::array<std::int32_t, 3>;
ChunkKey chunk_of(const Point& point);

class Spill {
 public:
  /// Writes to `file`, which is removed at the end. Throws Error(data) when the disk is full.
  explicit Spill(std::filesystem::path file, std::size_t buffered_points = 1 << 21);
  ~Spill();
  Spill(const Spill&) = delete;
  Spill& operator=(const Spill&) = delete;

  void add(const Point& point);
  void finish();  ///< call it before reading

  /// Every chunk that has points, with their number.
  std::vector<std::pair<ChunkKey, std::size_t>> chunks() const;
  /// Calls visit(const Point&) for the points of a chunk in the order in which they were added.
  template <class Visit>
  void read(ChunkKey key, Visit visit) {
    std::vector<Point> block;
    for (const Segment& s : segments_.at(key)) {
      load(s, block);
      for (const Point& p : block) visit(p);
    }
  }

 private:
  struct Segment {
    std::uint64_t first = 0;  ///< number of its first point in the file
    std::size_t points = 0;
  };
  void flush();
  void load(const Segment& segment, std::vector<Point>& block);

  std::filesystem::path path_;
  std::fstream file_;
  std::size_t limit_, buffered_ = 0;
  std::uint64_t written_ = 0;
  std::map<ChunkKey, std::vector<Point>> buffers_;
  std::map<ChunkKey, std::vector<Segment>> segments_;
};

}  // namespace web_view
