// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tiles.hpp"

namespace web_view {

/// The points of a chunk in the order in which they came, the first of each voxel and mission.
std::vector<Point> chunk_points(Spill& spill, ChunkKey chunk, const TileOptions& options);

}  // namespace web_view
