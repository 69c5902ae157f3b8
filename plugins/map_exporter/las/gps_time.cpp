// SPDX-License-Identifier: BSD-3-Clause
#include "gps_time.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>

namespace las {
namespace {

using namespace std::chrono;

// Leap seconds since GPS time began: IERS Bulletin C. None was announced after 2017.
constexpr sys_days leaps[] = {
    1981y / 7 / 1, 1982y / 7 / 1, 1983y / 7 / 1, 1985y / 7 / 1, 1988y / 1 / 1, 1990y / 1 / 1,
    1991y / 1 / 1, 1992y / 7 / 1, 1993y / 7 / 1, 1994y / 7 / 1, 1996y / 1 / 1, 1997y / 7 / 1,
    1999y / 1 / 1, 2006y / 1 / 1, 2009y / 1 / 1, 2012y / 7 / 1, 2015y / 7 / 1, 2017y / 1 / 1};
constexpr sys_days gps_epoch = 1980y / 1 / 6;

std::int64_t unix_seconds(sys_days day) {
  return duration_cast<seconds>(day.time_since_epoch()).count();
}

}  // namespace

double gps_time(const cambium::Stamp& stamp) {
  const auto passed = std::count_if(std::begin(leaps), std::end(leaps),
                                    [&](sys_days leap) { return stamp.sec >= unix_seconds(leap); });
  const std::int64_t sec = stamp.sec - unix_seconds(gps_epoch) + passed - 1'000'000'000;
  return double(sec) + 1e-9 * stamp.nsec;
}

Day day_of(const cambium::Stamp& stamp) {
  const sys_days day = floor<days>(sys_seconds(seconds(stamp.sec)));
  const year_month_day date(day);
  return {int((day - sys_days(date.year() / 1 / 1)).count()) + 1, int(date.year())};
}

}  // namespace las
