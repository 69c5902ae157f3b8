// SPDX-License-Identifier: BSD-3-Clause
// Which coordinate reference system an exporter writes.
#pragma once
#include <string>

#include "cambium/fused.hpp"
#include "cambium/projection.hpp"

namespace cambium::map_export {

inline constexpr const char* crs_doc =
    "Coordinate reference system, as PROJ names it: EPSG:32635, or EPSG:32635+5773 for heights "
    "above the geoid EGM96; utm: the zone of the first island's reference point";

/// `crs`, or for "utm" the zone of the first georeferenced island; that of the null point when
/// there is none (nothing is written then).
inline std::string crs_of(const std::string& crs, const Atlas& atlas) {
  if (crs != "utm") return crs;
  for (const Island& island : atlas.islands)
    if (const auto g = georeference(atlas, island)) return utm_zone(g->latitude, g->longitude);
  return utm_zone(0, 0);
}

}  // namespace cambium::map_export
