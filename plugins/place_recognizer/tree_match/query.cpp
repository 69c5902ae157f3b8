// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>

#include "search.hpp"

namespace tree_match {
namespace {

using cambium::Vec3;

float squared_distance(const Stem& s, float x, float y) {
  return (s.x - x) * (s.x - x) + (s.y - y) * (s.y - y);
}

/// The stems seen from within the window, those first that were seen from nearest by.
std::vector<Stem> in_view(const Place& place, std::size_t node, const QueryLimits& limits,
                          const Vec3& at) {
  const auto begin = place.path.begin();
  const double path = place.path[node];
  const auto first = std::lower_bound(begin, place.path.end(), path - limits.window) - begin;
  const auto last = std::upper_bound(begin, place.path.end(), path + limits.window) - begin - 1;
  std::vector<std::tuple<double, std::uint32_t>> by_lag;
  for (std::uint32_t i = 0; i < place.stems.size(); ++i) {
    const Stem& s = place.stems[i];
    if (s.first > last) break;  // they are in the order of their first sightings
    if (s.last < first ||
        squared_distance(s, float(at.x()), float(at.y())) > limits.range * limits.range)
      continue;
    by_lag.emplace_back(std::max({0.0, place.path[s.first] - path, path - place.path[s.last]}), i);
  }
  std::sort(by_lag.begin(), by_lag.end());
  std::vector<Stem> out;
  for (const auto& [lag, i] : by_lag) out.push_back(place.stems[i]);
  return out;
}

}  // namespace

// A stem that was in view for long is in the map several times: the one seen from nearest by
// counts.
std::vector<Stem> stems_around(const Place& place, std::size_t node, const QueryLimits& limits) {
  constexpr float same_stem = 0.6f;  // [m]
  const Vec3 at = place.T_mission_node[node].t - place.T_mission_node[0].t;
  const auto seen = in_view(place, node, limits, at);
  const StemGrid grid(seen);
  std::vector<char> again(seen.size(), 0);
  std::vector<std::pair<float, std::uint32_t>> by_distance;
  for (std::uint32_t i = 0; i < seen.size(); ++i) {
    if (again[i]) continue;
    grid.within(seen[i].x, seen[i].y, same_stem, [&](std::uint32_t k, float) { again[k] = 1; });
    by_distance.emplace_back(squared_distance(seen[i], float(at.x()), float(at.y())), i);
  }
  std::sort(by_distance.begin(), by_distance.end());
  if (by_distance.size() > std::size_t(limits.max_stems))
    by_distance.resize(std::size_t(limits.max_stems));
  std::vector<Stem> out;
  for (const auto& [distance, i] : by_distance) {
    Stem s = seen[i];
    s.x = float(s.x - at.x());
    s.y = float(s.y - at.y());
    s.z = float(s.z - at.z());
    out.push_back(s);
  }
  return out;
}

}  // namespace tree_match
