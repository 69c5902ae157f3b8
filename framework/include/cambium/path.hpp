// SPDX-License-Identifier: BSD-3-Clause
// Distance and time along the path of a mission.
#pragma once
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

/// Distance travelled up to each node [m], by the robot's own poses; 0 at the first.
std::vector<double> travelled(const Mission& mission);

/// From `a` to `b` [s], exact to the nanosecond where the seconds of two stamps are not.
inline double seconds_between(const Stamp& a, const Stamp& b) {
  return double(b.sec - a.sec) + 1e-9 * (b.nsec - a.nsec);
}

}  // namespace cambium
