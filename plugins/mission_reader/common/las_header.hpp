// SPDX-License-Identifier: BSD-3-Clause
// The head of a LAS file, versions 1.0 to 1.4, or of a LAZ file, which begins in the same way.
// Source: ASPRS, "LAS specification 1.4-R15", 2019.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>

namespace las {

struct Header {
  std::uint64_t points = 0;
  std::uint8_t format = 0;      ///< of the points, 0 to 10
  bool compressed = false;      ///< LAZ
  std::uint16_t record = 0;     ///< bytes a point, unpacked
  std::uint32_t to_points = 0;  ///< bytes before the first one
  std::array<double, 3> scale{}, offset{};
  std::array<double, 3> low{}, high{};  ///< extent as the file states it
  int year = 0, day = 0;                ///< day of the year; 0: not stated
  std::string crs;  ///< well-known text, or "EPSG:32635" from GeoTIFF keys; empty: not stated
};

/// Throws Error(data) naming the file: no LAS file, an unknown version or point format, counts that
/// contradict each other or the size of the file.
Header read_header(const std::filesystem::path& path);

/// The plane (or geographic) part of the well-known text of a compound system; of another system
/// the text itself.
std::string horizontal_part(const std::string& crs);

}  // namespace las
