// SPDX-License-Identifier: BSD-3-Clause
#include "engine/meeting.hpp"

#include <algorithm>
#include <cmath>

#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"

namespace cambium {
namespace {

constexpr std::size_t min_fixes = 5;  // a few wrong ones must not send a mission elsewhere
constexpr double max_delay = 10;      // between a fix and the node that it speaks of [s]
constexpr double sigmas = 3;
constexpr double map_drift = 0.05;  // [m/m]

Geodetic place_of(const GeoReference& g) { return {g.latitude, g.longitude, g.altitude}; }

Whereabouts around(const Vec3& p, double reach) {
  return {p.head<2>().array() - reach, p.head<2>().array() + reach};
}

void unite(std::optional<Whereabouts>& all, const Whereabouts& one) {
  if (!all) all = one;
  all->low = all->low.min(one.low);
  all->high = all->high.max(one.high);
}

/// The gap between two rectangles [m]; 0 when they touch.
double gap(const Whereabouts& a, const Whereabouts& b) {
  const Eigen::Array2d between = (a.low - b.high).max(b.low - a.high).max(0.0);
  return between.matrix().norm();
}

/// Nodes with a stamp, in order of time.
std::vector<std::pair<double, std::size_t>> nodes_in_time(const Mission& mission,
                                                          const Stamp& zero) {
  std::vector<std::pair<double, std::size_t>> out;
  for (std::size_t i = 0; i < mission.nodes.size(); ++i)
    if (const auto& stamp = mission.nodes[i].stamp)
      out.emplace_back(seconds_between(zero, *stamp), i);
  std::sort(out.begin(), out.end());
  return out;
}

/// The farthest that a node is, along the path, from one that a fix speaks of [m].
double out_of_sight(const Mission& mission, const std::vector<bool>& seen) {
  const auto path = travelled(mission);
  std::vector<double> distance(path.size(), INFINITY);
  const auto sweep = [&](auto begin, auto end, int step) {
    double last = INFINITY;
    for (auto i = begin; i != end; i += step) {
      if (seen[std::size_t(i)]) last = path[std::size_t(i)];
      distance[std::size_t(i)] =
          std::min(distance[std::size_t(i)], std::abs(path[std::size_t(i)] - last));
    }
  };
  sweep(std::ptrdiff_t(0), std::ptrdiff_t(path.size()), 1);
  sweep(std::ptrdiff_t(path.size()) - 1, std::ptrdiff_t(-1), -1);
  return *std::max_element(distance.begin(), distance.end());
}

std::optional<Whereabouts> by_fixes(const Mission& mission, const GeoReference& reference) {
  if (mission.fixes.size() < min_fixes) return std::nullopt;
  const auto nodes = nodes_in_time(mission, mission.fixes.front().stamp);
  std::vector<bool> seen(mission.nodes.size(), false);
  std::optional<Whereabouts> all;
  std::size_t used = 0;
  for (const GnssFix& fix : mission.fixes) {
    const double t = seconds_between(mission.fixes.front().stamp, fix.stamp);
    const auto after = std::lower_bound(nodes.begin(), nodes.end(), std::pair{t, std::size_t(0)});
    bool on_path = false;
    for (auto it = after == nodes.begin() ? after : after - 1; it != nodes.end() && it <= after;
         ++it)
      if (std::abs(it->first - t) <= max_delay) on_path = seen[it->second] = true;
    if (!on_path) continue;
    const double sigma = std::sqrt(std::max(fix.covariance(0, 0), fix.covariance(1, 1)));
    unite(all, around(to_enu(place_of(reference), {fix.latitude, fix.longitude, fix.altitude}),
                      sigmas * sigma));
    ++used;
  }
  if (used < min_fixes) return std::nullopt;
  const double slack = out_of_sight(mission, seen);
  return Whereabouts{all->low - slack, all->high + slack};
}

std::optional<Whereabouts> by_georeference(const Mission& mission, const GeoReference& reference) {
  if (!mission.georeference) return std::nullopt;
  Vec3 centre = Vec3::Zero();
  for (const Node& node : mission.nodes)
    centre += node.T_mission_node.t / double(mission.nodes.size());
  // The yaw of a short path is poorly known, and so is about which of its nodes it was fitted.
  double reach = (mission.nodes.front().T_mission_node.t - centre).norm();
  double farthest = 0;
  for (const Node& node : mission.nodes)
    farthest = std::max(farthest, (node.T_mission_node.t - centre).norm());
  return around(to_enu(place_of(reference), map_to_geodetic(*mission.georeference, centre)),
                reach + farthest);
}

/// Any place near the missions will do; the first one that is known.
std::optional<GeoReference> common_reference(const Atlas& atlas) {
  for (const MissionState& state : atlas.missions) {
    const Mission& m = *state.mission;
    if (!m.fixes.empty())
      return GeoReference{m.fixes[0].latitude, m.fixes[0].longitude, m.fixes[0].altitude, {}};
    if (m.georeference) return m.georeference;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Whereabouts> on_the_globe(const Mission& mission, const GeoReference& reference) {
  const auto fixes = by_fixes(mission, reference);
  return fixes ? fixes : by_georeference(mission, reference);
}

Whereabouts on_the_map(const MissionState& state) {
  const double drift = map_drift * travelled(*state.mission).back();
  std::optional<Whereabouts> all;
  for (const SE3& T : *state.T_map_node) unite(all, around(T.t, drift));
  return *all;
}

Meetings::Meetings(const Atlas& atlas, double max_distance)
    : atlas_(atlas), max_distance_(max_distance) {
  if (max_distance == 0) return;
  const auto reference = common_reference(atlas);
  for (const MissionState& state : atlas.missions) {
    globe_.push_back(reference ? on_the_globe(*state.mission, *reference) : std::nullopt);
    map_.push_back(on_the_map(state));
  }
}

Meetings::Apart Meetings::apart(std::uint32_t a, std::uint32_t b) const {
  if (max_distance_ == 0 || a == b) return Apart::no;
  if (atlas_.missions[a].island == atlas_.missions[b].island)
    return gap(map_[a], map_[b]) > max_distance_ ? Apart::by_map : Apart::no;
  if (globe_[a] && globe_[b] && gap(*globe_[a], *globe_[b]) > max_distance_) return Apart::by_gnss;
  return Apart::no;
}

}  // namespace cambium
