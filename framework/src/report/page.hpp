// SPDX-License-Identifier: BSD-3-Clause
// The report of a run for people: one HTML file that needs no network and nothing beside it.
#pragma once
#include "engine/report.hpp"

namespace cambium {

/// The page. `report` is that of report.json, `resolved` the text of resolved.yaml. Two scripts
/// hold the data: first "map", the same bytes for the same map, then "run", which has times.
std::string report_page(const Atlas& atlas, const Json& report, const std::string& resolved);

/// Missions with the paths of the robots (by odometry, placed where they begin in the map, and as
/// optimised) and their GNSS fixes, in the map frame of their island [m].
Json page_missions(const Atlas& atlas);

/// The ledger by columns; texts are numbers of `strings`. "before" and "after" say how far the
/// registered transform is from the odometry and from the map: metres and degrees.
Json page_ledger(const Atlas& atlas);

/// Rounded to `digits` significant ones: what a page needs, in fewer bytes.
double significant(double value, int digits);

}  // namespace cambium
