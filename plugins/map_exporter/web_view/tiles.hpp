// SPDX-License-Identifier: BSD-3-Clause
// Points as an octree of binary tiles with additive levels: a tile holds a sample of its cube, evenly
// spread, and the tiles of its eight octants hold the rest. Whoever draws a tile together with
// all tiles around it sees every point once. After M. Schuetz, S. Ohrhallinger, M. Wimmer, "Fast
// out-of-core octree generation for massive point clouds", Computer Graphics Forum 39(7), 2020.
#pragma once
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "spill.hpp"

namespace web_view {

constexpr int sample_bits = 6;  ///< a tile with octants has one point in each of 2^(3*6) voxels

/// A cube of space: its lowest corner and the logarithm of its width, in units.
struct Cube {
  std::array<std::int64_t, 3> low{};
  int bits = 0;  ///< the width is 2^bits
  Cube octant(int i) const;  ///< i = 4 x + 2 y + z, each 0 or 1
  int octant_of(const Point& point) const;
};

/// "r" is the root, "r3" its octant 3, "r31" that one's octant 1.
struct Tile {
  std::string name;
  Cube cube;
  std::vector<Point> points;
};

/// What there is of an island's points.
struct TileTree {
  Cube root;
  std::map<std::string, std::size_t> tiles;  ///< points by name; a tile may be empty, its octants not
  std::size_t points = 0;
};

struct TileOptions {
  std::size_t most_points = 20000;     ///< a cube with more is divided
  std::int64_t voxel = 0;              ///< width in units; 0: every point is kept
  std::vector<std::uint32_t> first_nodes;  ///< of each mission: voxels are its own
};

/// Hands every tile to `write`, octants before the cube that they lie in. Memory holds the points of
/// one chunk and a few tiles. `check` is called at least once a chunk; it may throw.
TileTree build_tiles(Spill& spill, const TileOptions& options,
                     const std::function<void(const Tile&)>& write,
                     const std::function<void()>& check);

/// The bytes of a tile: for each point x, y, z above the lowest corner in steps of 2^shift units
/// (16 bits each), intensity and label (8 bits each); then for each point its node (32 bits). Little
/// endian. Intensities from `low` to `high` become 0..255.
std::string tile_bytes(const Tile& tile, float low, float high);
int step_shift(int cube_bits);  ///< the shift for a cube of this width

}  // namespace web_view
