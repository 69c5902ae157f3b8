// SPDX-License-Identifier: BSD-3-Clause
#include "fixed_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "cambium/path.hpp"
#include "common/fixes.hpp"

namespace similarity_4dof {
namespace {

using cambium::GnssFix;
using cambium::Stamp;

/// Longitudes 179.9 and -179.9 are neighbours.
double across_date_line(double from, double to) { return std::remainder(to - from, 360.0); }

FixedNode between(const GnssFix& a, const GnssFix& b, double s) {
  FixedNode out;
  out.place.latitude = a.latitude + s * (b.latitude - a.latitude);
  out.place.longitude =
      std::remainder(a.longitude + s * across_date_line(a.longitude, b.longitude), 360.0);
  out.place.altitude = a.altitude + s * (b.altitude - a.altitude);
  // Not (1-s)^2 and s^2: the errors of neighbouring fixes are alike, so averaging gains nothing.
  out.covariance = (1 - s) * a.covariance + s * b.covariance;
  return out;
}

}  // namespace

std::vector<FixedNode> fixed_nodes(const cambium::Mission& mission, double max_gap) {
  const std::vector<GnssFix> fixes = cambium::gnss::fixes_in_time(mission);
  const std::vector<double> path = cambium::travelled(mission);
  struct Nearest {
    double difference;  // [s]
    FixedNode node;
  };
  std::map<std::size_t, Nearest> of_fix;
  for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
    const auto& stamp = mission.nodes[i].stamp;
    if (!stamp) continue;
    const auto after =
        std::lower_bound(fixes.begin(), fixes.end(), *stamp,
                         [](const GnssFix& fix, const Stamp& value) { return fix.stamp < value; });
    if (after == fixes.end()) continue;
    const bool exact = after->stamp == *stamp;
    if (!exact && after == fixes.begin()) continue;
    const auto before = exact ? after : std::prev(after);
    const double gap = seconds_between(before->stamp, after->stamp);
    if (gap > max_gap) continue;
    const double s = exact ? 0.0 : seconds_between(before->stamp, *stamp) / gap;
    FixedNode node = between(*before, *after, s);
    node.node = i;
    node.path = path[i];
    const double difference = std::min(s, 1 - s) * gap;
    const auto nearest = std::size_t((s <= 0.5 ? before : after) - fixes.begin());
    const auto [it, is_new] = of_fix.try_emplace(nearest, Nearest{difference, node});
    if (!is_new && difference < it->second.difference) it->second = {difference, node};
  }
  std::vector<FixedNode> out;
  for (const auto& [fix, nearest] : of_fix) out.push_back(nearest.node);
  return out;
}

std::vector<FixedNode> choose(const std::vector<FixedNode>& nodes, std::size_t count, bool spread) {
  if (nodes.size() <= count) return nodes;
  if (!spread) return {nodes.begin(), nodes.begin() + std::ptrdiff_t(count)};
  const double first = nodes.front().path, last = nodes.back().path;
  std::vector<FixedNode> out;
  std::size_t next = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double wanted = first + (last - first) * double(k) / double(count - 1);
    // Leaves enough nodes for those still to come, so that `count` are always found.
    const std::size_t last_allowed = nodes.size() - (count - k);
    while (next < last_allowed && nodes[next].path < wanted) ++next;
    out.push_back(nodes[next++]);
  }
  return out;
}

}  // namespace similarity_4dof
