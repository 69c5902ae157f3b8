// SPDX-License-Identifier: BSD-3-Clause
// One point cloud from a .las or .laz file, versions 1.0 to 1.4.
// Source: ASPRS, "LAS specification 1.4-R15", 2019.
#pragma once
#include "cloud_file.hpp"

namespace cambium {

/// x, y, z, intensity, and the classes as labels where a point has one. Coordinates must be those
/// of the base frame: farther than 100 km they would lose centimetres as floats, and are refused.
/// Throws Error(data) naming the file: see las::read_header and las::for_each_point.
LoadedCloud load_las(const std::filesystem::path& path);

}  // namespace cambium
