// SPDX-License-Identifier: BSD-3-Clause
#include "common/fixes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cambium/error.hpp"

namespace cambium::gnss {
namespace {

bool usable(const GnssFix& fix) {
  return std::isfinite(fix.latitude + fix.longitude + fix.altitude) &&
         std::abs(fix.latitude) <= 90 && fix.covariance.allFinite() && fix.covariance(0, 0) > 0 &&
         fix.covariance(1, 1) > 0;
}

}  // namespace

std::vector<GnssFix> fixes_in_time(const Mission& mission) {
  std::vector<GnssFix> fixes = mission.fixes;
  for (std::size_t i = 0; i < fixes.size(); ++i) {
    if (usable(fixes[i])) continue;
    throw Error(ErrorCode::data, mission.folder.string(),
                "GNSS fix " + std::to_string(i) + " of mission " + mission.name +
                    " is no place on the globe or has no positive variance east and "
                    "north; expected finite degrees, metres and square metres");
  }
  std::stable_sort(fixes.begin(), fixes.end(),
                   [](const GnssFix& a, const GnssFix& b) { return a.stamp < b.stamp; });
  return fixes;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace cambium::gnss
