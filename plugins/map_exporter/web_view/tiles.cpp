// SPDX-License-Identifier: BSD-3-Clause
#include "tiles.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "chunk_points.hpp"

namespace web_view {
namespace {

using Chunks = std::vector<std::pair<ChunkKey, std::size_t>>;

/// The smallest cube of 2^n chunks that starts at the lowest corner of all chunks.
Cube root_of(const Chunks& chunks) {
  std::array<std::int64_t, 3> low, high;
  low.fill(std::numeric_limits<std::int64_t>::max());
  high.fill(std::numeric_limits<std::int64_t>::min());
  for (const auto& [key, count] : chunks)
    for (int a = 0; a < 3; ++a) {
      low[a] = std::min<std::int64_t>(low[a], key[a]);
      high[a] = std::max<std::int64_t>(high[a], key[a]);
    }
  std::uint64_t width = 1;
  Cube root;
  for (int a = 0; a < 3; ++a) {
    width = std::max(width, std::uint64_t(high[a] - low[a]) + 1);
    root.low[a] = low[a] * (1 << chunk_bits);
  }
  root.bits = chunk_bits + std::bit_width(width - 1);
  return root;
}

/// Moves one point of each voxel out of the octants: the one with the lowest mixed number, so that
/// missions share a voxel as they share the points in it.
std::vector<Point> sample(const Cube& cube, std::array<std::vector<Point>, 8>& octants) {
  const int voxel_bits = cube.bits - sample_bits;
  const auto voxel = [&](const Point& p) {
    const auto index = [&](std::int32_t v, int a) {
      return std::size_t((v - cube.low[a]) >> voxel_bits);
    };
    return (index(p.x, 0) << sample_bits | index(p.y, 1)) << sample_bits | index(p.z, 2);
  };
  const auto rank = [](const Point& p) {
    return mixed(mixed(std::uint64_t(std::uint32_t(p.x)) << 32 | std::uint32_t(p.y)) ^
                 (std::uint64_t(std::uint32_t(p.z)) << 32 | p.node)) | 1;  // 0 means taken
  };
  std::vector<std::uint64_t> best(std::size_t(1) << (3 * sample_bits),
                                  std::numeric_limits<std::uint64_t>::max());
  for (const auto& points : octants)
    for (const Point& p : points) best[voxel(p)] = std::min(best[voxel(p)], rank(p));
  std::vector<Point> taken;
  for (auto& points : octants)
    std::erase_if(points, [&](const Point& p) {
      std::uint64_t& wanted = best[voxel(p)];
      if (wanted != rank(p)) return false;
      wanted = 0;  // of two points that are the same, one
      taken.push_back(p);
      return true;
    });
  return taken;
}

class Builder {
 public:
  Builder(Spill& spill, const TileOptions& options, const std::function<void(const Tile&)>& write,
          const std::function<void()>& check)
      : spill_(spill), options_(options), write_(write), check_(check) {}

  TileTree build() {
    const Chunks chunks = spill_.chunks();
    if (chunks.empty()) return {};
    tree_.root = root_of(chunks);
    finish({"r", tree_.root, of_chunks("r", tree_.root, chunks)});
    return std::move(tree_);
  }

 private:
  // Each returns the cube's own points; its octants are written.
  std::vector<Point> of_chunks(const std::string& name, const Cube& cube, const Chunks& chunks) {
    if (cube.bits == chunk_bits) {
      check_();
      return of_points(name, cube,
                       chunk_points(spill_, chunks.front().first, options_));
    }
    std::array<Chunks, 8> parts;
    for (const auto& chunk : chunks) {
      const auto corner = [&](int a) { return chunk.first[a] * (1 << chunk_bits); };
      parts[cube.octant_of({corner(0), corner(1), corner(2)})].push_back(chunk);
    }
    return of_octants(name, cube, [&](int i, const std::string& child) {
      return parts[i].empty() ? std::vector<Point>{} : of_chunks(child, cube.octant(i), parts[i]);
    });
  }

  std::vector<Point> of_points(const std::string& name, const Cube& cube,
                               std::vector<Point> points) {
    // A voxel of one unit cannot be divided.
    if (points.size() <= options_.most_points || cube.bits <= sample_bits) return points;
    std::array<std::vector<Point>, 8> parts;
    for (const Point& p : points) parts[cube.octant_of(p)].push_back(p);
    std::vector<Point>().swap(points);
    return of_octants(name, cube, [&](int i, const std::string& child) {
      return of_points(child, cube.octant(i), std::move(parts[i]));
    });
  }

  template <class OwnPoints>
  std::vector<Point> of_octants(const std::string& name, const Cube& cube, OwnPoints own_points) {
    std::array<std::vector<Point>, 8> octants;
    for (int i = 0; i < 8; ++i) octants[i] = own_points(i, name + char('0' + i));
    std::size_t total = 0;
    bool divided = false;
    for (int i = 0; i < 8; ++i) {
      total += octants[i].size();
      divided = divided || has_octants(name + char('0' + i));
    }
    std::vector<Point> own;
    if (total <= options_.most_points && !divided) {  // octants of octants would stay behind
      for (auto& points : octants) own.insert(own.end(), points.begin(), points.end());
      return own;
    }
    own = sample(cube, octants);
    for (int i = 0; i < 8; ++i)
      finish({name + char('0' + i), cube.octant(i), std::move(octants[i])});
    return own;
  }

  bool has_octants(const std::string& name) const {
    const auto next = tree_.tiles.lower_bound(name + '0');
    return next != tree_.tiles.end() && next->first.starts_with(name);
  }

  void finish(const Tile& tile) {
    if (tile.points.empty() && !has_octants(tile.name)) return;
    tree_.tiles[tile.name] = tile.points.size();
    tree_.points += tile.points.size();
    if (!tile.points.empty()) write_(tile);
  }

  Spill& spill_;
  const TileOptions& options_;
  const std::function<void(const Tile&)>& write_;
  const std::function<void()>& check_;
  TileTree tree_;
};

}  // namespace

Cube Cube::octant(int i) const {
  const std::int64_t half = std::int64_t(1) << (bits - 1);
  return {{low[0] + (i >> 2 & 1) * half, low[1] + (i >> 1 & 1) * half, low[2] + (i & 1) * half},
          bits - 1};
}

int Cube::octant_of(const Point& p) const {
  const auto upper = [&](std::int32_t v, int a) { return int((v - low[a]) >> (bits - 1)); };
  return upper(p.x, 0) << 2 | upper(p.y, 1) << 1 | upper(p.z, 2);
}

TileTree build_tiles(Spill& spill, const TileOptions& options,
                     const std::function<void(const Tile&)>& write,
                     const std::function<void()>& check) {
  return Builder(spill, options, write, check).build();
}

}  // namespace web_view
