// SPDX-License-Identifier: BSD-3-Clause
// The head of a LAS 1.4 file: public header block and variable length records.
// Source: ASPRS, "LAS specification 1.4-R15", 2019.
#pragma once
#include <cstdint>
#include <limits>
#include <string>

#include "cambium/se3.hpp"
#include "gps_time.hpp"

namespace las {

constexpr double scale = 0.001;  ///< of the stored coordinates [m]: off by half a millimetre

struct Header {
  bool colours = false;  ///< point format 7, else 6
  std::string wkt;       ///< of the coordinate reference system; empty: not stated
  std::string missions;  ///< a line for each point source id
  Day day;               ///< of the file
  cambium::Vec3 offset = cambium::Vec3::Zero();
  std::uint64_t points = 0;
  /// Extent of the stored points [scale].
  std::int32_t low[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
  std::int32_t high[3] = {INT32_MIN, INT32_MIN, INT32_MIN};

  std::size_t record_length() const { return colours ? 36 : 30; }
  /// The bytes before the first point; their number does not depend on the points.
  std::string bytes() const;
};

}  // namespace las
