// SPDX-License-Identifier: BSD-3-Clause
// Fixes and places as every aligner wants them.
#pragma once
#include <numbers>
#include <string>
#include <vector>

#include "cambium/geodesy.hpp"

namespace cambium::gnss {

inline constexpr double degree = std::numbers::pi / 180;

/// The same place measured and mapped.
struct Pair {
  Vec3 p_enu, p_map;
  Mat3 covariance;  ///< of p_enu, east, north, up [m^2]
};

/// The mean variance of a horizontal axis [m^2].
inline double horizontal_variance(const Mat3& covariance) {
  return (covariance(0, 0) + covariance(1, 1)) / 2;
}

/// The mission's fixes in order of time. Throws Error(data) on one that is no place on the globe or
/// has no positive variance east and north.
std::vector<GnssFix> fixes_in_time(const Mission& mission);

inline Geodetic place_of(const GnssFix& fix) { return {fix.latitude, fix.longitude, fix.altitude}; }

/// Three digits, for messages.
std::string number(double value);

}  // namespace cambium::gnss
