// SPDX-License-Identifier: BSD-3-Clause
// What the headers of PCD and PLY files promise. PCL only prints what it misses in a damaged file;
// this finds it first and says it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <vector>

namespace cambium {

struct CloudHeader {
  enum class Data { ascii, binary, compressed } data = Data::ascii;
  std::uint64_t points = 0, bytes_per_point = 0, values_per_point = 0;
  bool sized = true;  ///< where the points end follows from the header
  std::vector<std::string> fields;
};

/// Both leave the stream at the first point and throw Error(data).
CloudHeader pcd_header(std::istream& in, const std::filesystem::path& path);
CloudHeader ply_header(std::istream& in, const std::filesystem::path& path);

/// Points that the header promises. Throws Error(data) when the header is not one of a cloud with
/// x, y, z, when its counts contradict each other, or when the file holds another number of points.
std::uint64_t checked_point_count(const std::filesystem::path& path);

// What both headers need.
std::vector<std::string> words_of(const std::string& line);
std::uint64_t count_in(const std::filesystem::path& path, const std::string& text,
                       const std::string& what);
[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& what);

}  // namespace cambium
