// SPDX-License-Identifier: BSD-3-Clause
// Exact WGS 84 geodesy (GeographicLib); linearising costs 4 m at 5 km.
#pragma once
#include "cambium/mission.hpp"

namespace cambium {

/// [deg], altitude above the ellipsoid [m]
struct Geodetic {
  double latitude = 0, longitude = 0, altitude = 0;
};

Vec3 to_enu(const Geodetic& reference, const Geodetic& point);       ///< local Cartesian [m]
Geodetic from_enu(const Geodetic& reference, const Vec3& p_enu);

/// A point of the map on the globe, through p_map = T_map_enu * p_enu.
Geodetic map_to_geodetic(const GeoReference& georeference, const Vec3& p_map);

}  // namespace cambium
