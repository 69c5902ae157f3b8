// SPDX-License-Identifier: BSD-3-Clause
#include "common/track.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cambium/path.hpp"

namespace cambium::gnss {
namespace {

struct TimedNode {
  double seconds;
  std::uint32_t node;
};

std::vector<TimedNode> nodes_in_time(const Mission& mission, const Stamp& zero) {
  std::vector<TimedNode> out;
  for (std::uint32_t i = 0; i < mission.nodes.size(); ++i)
    if (const auto& stamp = mission.nodes[i].stamp)
      out.push_back({seconds_between(zero, *stamp), i});
  std::stable_sort(out.begin(), out.end(),
                   [](const TimedNode& a, const TimedNode& b) { return a.seconds < b.seconds; });
  return out;
}

std::optional<Stamp> first_stamp(const Mission& mission) {
  for (const Node& node : mission.nodes)
    if (node.stamp) return node.stamp;
  return std::nullopt;
}

/// Between which nodes; nothing off the path or in a gap.
std::optional<Measurement> locate(const std::vector<TimedNode>& path, double seconds,
                                  double max_gap) {
  const auto after =
      std::lower_bound(path.begin(), path.end(), seconds,
                       [](const TimedNode& node, double value) { return node.seconds < value; });
  if (after == path.end()) return std::nullopt;
  Measurement m;
  m.seconds = seconds;
  m.before = m.after = after->node;
  if (after->seconds == seconds) return m;
  if (after == path.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap = after->seconds - before->seconds;
  if (gap > max_gap) return std::nullopt;
  m.before = before->node;
  m.share = (seconds - before->seconds) / gap;
  return m;
}

Track track_of(const MissionState& state, const Mounting& mounting, Tracks& all) {
  Track track;
  const auto zero = first_stamp(*state.mission);
  const auto fixes = fixes_in_time(*state.mission);
  all.fixes += fixes.size();
  if (!zero) return track;
  const auto path = nodes_in_time(*state.mission, *zero);
  const Vec3 lever(mounting.lever_arm[0], mounting.lever_arm[1], mounting.lever_arm[2]);
  const auto& T_map_node = *state.T_map_node;
  for (const GnssFix& fix : fixes) {
    auto m =
        locate(path, seconds_between(*zero, fix.stamp) + mounting.time_offset, mounting.max_gap);
    if (!m) continue;
    if (all.tracks.empty() && track.measurements.empty()) all.reference = place_of(fix);
    const SE3 T_map_base = interpolate(T_map_node[m->before], T_map_node[m->after], m->share);
    m->pair = {to_enu(all.reference, place_of(fix)), T_map_base * lever, fix.covariance};
    track.measurements.push_back(*m);
  }
  return track;
}

}  // namespace

void Mounting::params(ParamVisitor& v) {
  v("lever_arm", lever_arm, "The antenna in the base frame: x, y, z", in_unit("m"));
  v("time_offset", time_offset, "Added to the stamps of the fixes", in_unit("s"));
  v("max_gap", max_gap, "Fixes between nodes farther apart in time have no place on the path",
    above(0, "s"));
}

std::string Mounting::check() const {
  if (lever_arm.size() == 3) return {};
  return "lever_arm has " + std::to_string(lever_arm.size()) +
         " numbers, expected x, y and z of the antenna in the base frame";
}

std::vector<Pair> Tracks::pairs() const {
  std::vector<Pair> out;
  for (const Track& track : tracks)
    for (const Measurement& m : track.measurements) out.push_back(m.pair);
  return out;
}

Tracks find_tracks(const Atlas& atlas, const Island& island, const Mounting& mounting) {
  Tracks out;
  for (const std::uint32_t m : island.missions) {
    Track track = track_of(atlas.missions[m], mounting, out);
    track.mission = m;
    if (!track.measurements.empty()) out.tracks.push_back(std::move(track));
  }
  return out;
}

}  // namespace cambium::gnss
