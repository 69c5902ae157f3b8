// SPDX-License-Identifier: BSD-3-Clause
// The points of a LAS or LAZ file, one block after the other.
#pragma once
#include <cstring>
#include <functional>

#include "common/las_header.hpp"

namespace las {

/// A point as it is stored.
struct Point {
  double x = 0, y = 0, z = 0;  ///< in the file's system
  std::uint16_t intensity = 0;
  std::uint8_t classification = 0;  ///< ASPRS class
};

/// Calls visit(point) for every point in the order of the file. LAZ is unpacked by Python 3 with
/// the packages laspy and lazrs, as a child process that hands over the points as they come. Throws
/// Error(data) naming the file: points are missing or damaged, or there is nobody to unpack it.
void for_each_point(const std::filesystem::path& path, const Header& header,
                    const std::function<void(const Point&)>& visit);

}  // namespace las
