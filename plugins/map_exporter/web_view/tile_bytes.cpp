// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cstring>

#include "tiles.hpp"

namespace web_view {
namespace {

static_assert(std::endian::native == std::endian::little, "tiles are written as memory is");

std::uint8_t byte_of(float intensity, float low, float high) {
  const float share = high > low ? (intensity - low) / (high - low) : 0.5f;
  return share > 0 ? std::uint8_t(std::min(255 * share + 0.5f, 255.0f)) : 0;  // 0 for NaN, too
}

}  // namespace

int step_shift(int cube_bits) { return std::max(0, cube_bits - 16); }

std::string tile_bytes(const Tile& tile, float low, float high) {
  const std::size_t count = tile.points.size();
  std::vector<std::uint16_t> front;
  std::vector<std::uint32_t> nodes;
  front.reserve(4 * count);
  nodes.reserve(count);
  const int shift = step_shift(tile.cube.bits);
  for (const Point& p : tile.points) {
    const std::int32_t at[] = {p.x, p.y, p.z};
    for (int a = 0; a < 3; ++a) front.push_back(std::uint16_t((at[a] - tile.cube.low[a]) >> shift));
    front.push_back(std::uint16_t(byte_of(p.intensity, low, high) | std::min(p.label, 255u) << 8));
    nodes.push_back(p.node);
  }
  std::string out(12 * count, '\0');
  if (count == 0) return out;
  std::memcpy(out.data(), front.data(), 8 * count);
  std::memcpy(out.data() + 8 * count, nodes.data(), 4 * count);
  return out;
}

}  // namespace web_view
