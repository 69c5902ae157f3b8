// SPDX-License-Identifier: BSD-3-Clause
// One point cloud from a .pcd or .ply file.
#pragma once
#include <cstddef>
#include <filesystem>

#include "cambium/payload.hpp"

namespace cambium {

struct LoadedCloud {
  Cloud cloud;
  std::size_t not_finite = 0;  ///< points that were removed because a coordinate is NaN or infinite
};

/// x, y, z as float or double; normals (normal_x.. or nx..) and intensity when they are there.
/// `apply_viewpoint` moves the points by the pose that the file carries (PCD VIEWPOINT).
/// Safe to call from several threads. Throws Error(data) naming the file.
LoadedCloud load_cloud(const std::filesystem::path& path, bool apply_viewpoint);

}  // namespace cambium
