// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/geodesy.hpp"

#include <fmt/format.h>

#include <GeographicLib/LocalCartesian.hpp>
#include <cmath>

#include "cambium/error.hpp"

namespace cambium {
namespace {

// GeographicLib answers NaN for a latitude beyond the poles; a map full of NaN is found much later.
void check(const Geodetic& g, const char* what) {
  if (std::abs(g.latitude) <= 90 && std::isfinite(g.longitude) && std::isfinite(g.altitude)) return;
  throw Error(
      ErrorCode::data, "",
      fmt::format("the {} is latitude {}, longitude {}, altitude {}; expected degrees with a "
                  "latitude within -90..90 and finite numbers",
                  what, g.latitude, g.longitude, g.altitude));
}

GeographicLib::LocalCartesian local_frame(const Geodetic& reference) {
  check(reference, "reference point");
  return {reference.latitude, reference.longitude, reference.altitude};
}

}  // namespace

Vec3 to_enu(const Geodetic& reference, const Geodetic& point) {
  const auto frame = local_frame(reference);
  check(point, "point");
  Vec3 p_enu;
  frame.Forward(point.latitude, point.longitude, point.altitude, p_enu.x(), p_enu.y(), p_enu.z());
  return p_enu;
}

Geodetic from_enu(const Geodetic& reference, const Vec3& p_enu) {
  Geodetic g;
  local_frame(reference).Reverse(p_enu.x(), p_enu.y(), p_enu.z(), g.latitude, g.longitude,
                                 g.altitude);
  return g;
}

Geodetic map_to_geodetic(const GeoReference& georeference, const Vec3& p_map) {
  const Geodetic reference{georeference.latitude, georeference.longitude, georeference.altitude};
  return from_enu(reference, georeference.T_map_enu.inverse() * p_map);
}

}  // namespace cambium
