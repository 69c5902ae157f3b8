// SPDX-License-Identifier: BSD-3-Clause
#include "chunk_points.hpp"

#include <algorithm>

#include "common/voxel_set.hpp"

namespace web_view {

std::vector<Point> chunk_points(Spill& spill, ChunkKey chunk, const TileOptions& options) {
  std::vector<Point> out;
  // Missions come one after another, so that one set of voxels serves all.
  std::optional<cambium::map_export::VoxelSet> taken;
  std::ptrdiff_t mission = -1;
  spill.read(chunk, [&](const Point& p) {
    if (options.voxel > 1) {
      const auto& first = options.first_nodes;
      const auto of = std::upper_bound(first.begin(), first.end(), p.node) - first.begin();
      if (of != mission) taken.emplace(double(options.voxel));
      mission = of;
      const auto in_chunk = [&](std::int32_t v, int a) {
        return double(v - chunk[a] * (std::int64_t(1) << chunk_bits));
      };
      if (!taken->insert({in_chunk(p.x, 0), in_chunk(p.y, 1), in_chunk(p.z, 2)})) return;
    }
    out.push_back(p);
  });
  return out;
}

}  // namespace web_view
