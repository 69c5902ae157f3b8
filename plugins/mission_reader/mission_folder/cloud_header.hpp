// SPDX-License-Identifier: BSD-3-Clause
// What the headers of PCD and PLY files promise. PCL only prints what it misses in a damaged file;
// this finds it first and says it.
#pragma once
#include <cstdint>
#include <filesystem>

namespace cambium {

/// Points that the header promises. Throws Error(data) when the header is not one of a cloud with
/// x, y, z, when its counts contradict each other, or when the file holds another number of points.
std::uint64_t checked_point_count(const std::filesystem::path& path);

}  // namespace cambium
