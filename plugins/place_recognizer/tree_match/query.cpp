// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "search.hpp"

namespace tree_match {

using cambium::Vec3;

// A stem that was in view for long is in the map several times: the one seen from nearest by
// counts.
std::vector<Stem> stems_around(const Place& place, std::size_t node, const QueryLimits& limits) {
  constexpr double same_stem = 0.6;  // [m]
  const Vec3 at = place.T_mission_node[node].t - place.T_mission_node[0].t;
  const double path = place.path[node];
  std::vector<std::tuple<double, std::size_t>> by_lag;  // along the path, stem
  const auto distance = [&](const Stem& s) { return std::hypot(s.x - at.x(), s.y - at.y()); };
  for (std::size_t i = 0; i < place.stems.size(); ++i) {
    const Stem& s = place.stems[i];
    const double lag = std::max({0.0, place.path[s.first] - path, path - place.path[s.last]});
    if (lag <= limits.window && distance(s) <= limits.range) by_lag.emplace_back(lag, i);
  }
  std::sort(by_lag.begin(), by_lag.end());
  std::vector<Stem> out;
  for (const auto& [lag, i] : by_lag) {
    const Stem& s = place.stems[i];
    const auto same = [&](const Stem& o) { return std::hypot(o.x - s.x, o.y - s.y) < same_stem; };
    if (std::none_of(out.begin(), out.end(), same)) out.push_back(s);
  }
  std::stable_sort(out.begin(), out.end(),
                   [&](const Stem& a, const Stem& b) { return distance(a) < distance(b); });
  if (out.size() > std::size_t(limits.max_stems)) out.resize(std::size_t(limits.max_stems));
  for (Stem& s : out) {
    s.x = float(s.x - at.x());
    s.y = float(s.y - at.y());
    s.z = float(s.z - at.z());
  }
  return out;
}

}  // namespace tree_match
