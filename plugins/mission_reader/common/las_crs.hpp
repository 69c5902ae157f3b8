// SPDX-License-Identifier: BSD-3-Clause
// The coordinate reference system in the variable length records of a LAS file.
#pragma once
#include <cstdint>
#include <istream>
#include <string>

namespace las {

/// From `count` records that begin at `begin` and end before `end` [bytes]: well-known text (record
/// 2112), or else the EPSG code of the GeoTIFF keys (record 34735) as "EPSG:32635" or, with
/// heights, "EPSG:32635+5773". Empty when there is neither; a list of records that is cut off ends
/// early.
std::string crs_in_records(std::istream& in, std::uint64_t begin, std::uint32_t count,
                           std::uint64_t end);

}  // namespace las
