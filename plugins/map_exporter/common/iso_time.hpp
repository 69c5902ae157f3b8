// SPDX-License-Identifier: BSD-3-Clause
// Stamps, which are UTC, as people and other programs write them.
#pragma once
#include <chrono>
#include <cstdio>
#include <string>

#include "cambium/mission.hpp"

namespace cambium::map_export {

/// Of the Gregorian calendar.
struct DateTime {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0;
  double second = 0;
};

inline DateTime date_time(const Stamp& stamp) {
  using namespace std::chrono;
  const sys_seconds time{seconds(stamp.sec)};
  const year_month_day date(floor<days>(time));
  const hh_mm_ss clock(time - floor<days>(time));
  return {int(date.year()),
          int(unsigned(date.month())),
          int(unsigned(date.day())),
          int(clock.hours().count()),
          int(clock.minutes().count()),
          double(clock.seconds().count()) + 1e-9 * stamp.nsec};
}

/// ISO 8601, cut off at the millisecond: 2020-03-10T11:37:41.039Z
inline std::string iso_time(const Stamp& stamp) {
  const DateTime t = date_time(stamp);
  char text[80];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", t.year, t.month, t.day,
                t.hour, t.minute, int(t.second), int(stamp.nsec / 1'000'000));
  return text;
}

}  // namespace cambium::map_export
