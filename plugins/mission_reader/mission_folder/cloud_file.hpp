// SPDX-License-Identifier: BSD-3-Clause
// One point cloud from a .pcd, .ply, .las or .laz file.
#pragma once
#include <cstddef>
#include <filesystem>

#include "cambium/payload.hpp"

namespace cambium {

struct LoadedCloud {
  Cloud cloud;
  std::size_t not_finite = 0;  ///< points that were removed because a coordinate is NaN or infinite
};

/// x, y, z as float or double; normals (normal_x.. or nx..), intensity and label (or
/// classification) when they are there. `apply_viewpoint` moves the points by the pose that the
/// file carries (PCD VIEWPOINT; LAS has none). Safe to call from several threads. Throws
/// Error(data) naming the file.
LoadedCloud load_cloud(const std::filesystem::path& path, bool apply_viewpoint);

}  // namespace cambium
