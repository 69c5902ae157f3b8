// SPDX-License-Identifier: BSD-3-Clause
// The time of LAS points.
#pragma once
#include "cambium/mission.hpp"

namespace las {

/// Adjusted standard GPS time [s]: since 1980-01-06 by GPS, less 1e9. Stamps are UTC since 1970.
double gps_time(const cambium::Stamp& stamp);

/// Day of the year (from 1) and year of a stamp, UTC.
struct Day {
  int day = 0, year = 0;
};
Day day_of(const cambium::Stamp& stamp);

}  // namespace las
