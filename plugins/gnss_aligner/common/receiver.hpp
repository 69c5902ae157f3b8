// SPDX-License-Identifier: BSD-3-Clause
// Receivers for the tests of aligners: correlated noise, and what goes wrong under trees.
#pragma once
#include <cmath>
#include <random>

#include "cambium/statistics.hpp"
#include "common/fixes.hpp"
#include "support/support.hpp"

namespace cambium::testing {

inline const Geodetic place{61.2, 25.1, 130.0};

struct Receiver {
  double sigma = 0, correlation_time = 0;  ///< of one axis [m, s]; 0 s: white
  double rate = 1;                         ///< [Hz]
  double outage = 0;                       ///< share of the time without fixes
  double jump = 0;                         ///< share of the time with fixes 20 m off
  double bend = 0;                         ///< share of the path, its end, that drifts off by 40 m
  Vec3 lever_arm = Vec3::Zero();           ///< [m]
  double time_offset = 0;                  ///< fixes are stamped so much too early [s]
};

/// n nodes `step` metres apart on a path that winds (`wave` [m] to each side) or, with a bend, on a
/// part of a circle; one each `step` seconds, so 1 m/s.
inline std::vector<SE3> winding(int n, double step, double wave = 20) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) {
    const double x = i * step;
    poses.push_back(
        SE3::from_yaw(std::atan(wave / 60 * std::cos(x / 60)), {x, wave * std::sin(x / 60), 0.0}));
  }
  return poses;
}
inline std::vector<SE3> circle(int n, double step) {
  std::vector<SE3> poses{SE3{}};
  const double turn = 2 * std::numbers::pi / n;
  for (int i = 1; i < n; ++i) poses.push_back(poses.back() * SE3::from_yaw(turn, {step, 0, 0}));
  return poses;
}

/// Stamps the nodes `step` seconds apart.
inline Mission walked(const std::string& name, const std::vector<SE3>& poses, int step) {
  Mission mission = make_mission(name, poses);
  for (std::size_t i = 0; i < mission.nodes.size(); ++i)
    mission.nodes[i].stamp = Stamp{std::int64_t(i) * step, 0};
  return mission;
}

/// What went wrong with a share of the time, in pieces of 30 s, a little more or less often than on
/// average as the seed has it.
inline std::vector<bool> episodes(double share, double seconds, std::mt19937& random) {
  std::vector<bool> on;
  for (double t = 0; t <= seconds; t += 30)
    on.push_back(std::uniform_real_distribution<double>(0, 1)(random) < share);
  return on;
}

inline Mission with_receiver(Mission mission, const SE3& T_map_enu, const Receiver& r,
                             unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0, 1);
  const double memory = r.correlation_time > 0 ? std::exp(-1 / (r.rate * r.correlation_time)) : 0.0;
  const double end = mission.nodes.back().stamp->seconds();
  const auto outages = episodes(r.outage, end, random), jumps = episodes(r.jump, end, random);
  Vec3 error(normal(random), normal(random), normal(random));
  std::size_t at = 0;
  for (double t = 0; t <= end; t += 1 / r.rate) {
    while (at + 2 < mission.nodes.size() && mission.nodes[at + 1].stamp->seconds() <= t) ++at;
    const double from = mission.nodes[at].stamp->seconds(),
                 to = mission.nodes[at + 1].stamp->seconds();
    const SE3 T = interpolate(mission.nodes[at].T_mission_node,
                              mission.nodes[at + 1].T_mission_node, (t - from) / (to - from));
    Vec3 p_enu = T_map_enu.inverse() * (T * r.lever_arm);
    for (int k = 0; k < 3; ++k) p_enu[k] += (k == 2 ? 2 : 1) * r.sigma * error[k];
    if (jumps[std::size_t(t / 30)]) p_enu += Vec3(16, -12, 30);
    p_enu.x() += 40 * std::max(0.0, (t / end - (1 - r.bend)) / std::max(r.bend, 1e-9));
    for (int k = 0; k < 3; ++k)
      error[k] = memory * error[k] + std::sqrt(1 - memory * memory) * normal(random);
    if (outages[std::size_t(t / 30)]) continue;
    const Geodetic g = from_enu(place, p_enu);
    const double stamped = t - r.time_offset;
    const double sec = std::floor(stamped);
    const double s = r.sigma > 0 ? r.sigma : 1;
    mission.fixes.push_back({{std::int64_t(sec), std::int32_t((stamped - sec) * 1e9)},
                             g.latitude,
                             g.longitude,
                             g.altitude,
                             Mat3(Vec3(s * s, s * s, 4 * s * s).asDiagonal())});
  }
  return mission;
}

inline GnssAlignment align(const std::string& plugin, const Atlas& atlas,
                           const std::string& yaml = "{}") {
  return component<GnssAligner>(plugin, yaml)->align(atlas, atlas.islands[0], *make_context());
}

inline double score(const GnssAlignment& a, const std::string& name) {
  for (const auto& [key, value] : a.scores)
    if (key == name) return value;
  return std::nan("");
}

/// Yaw off the truth [rad]; with `T_map_enu` meant at `place`, and the reference a few hundred
/// metres from it, the meridians' convergence (0.001 deg) does not show.
inline double yaw_error(const GnssAlignment& a, const SE3& T_map_enu) {
  return std::remainder(a.georeference->T_map_enu.yaw() - T_map_enu.yaw(), 2 * std::numbers::pi);
}

/// How far a point of the map is put from its true place, east, north, up [m].
inline Vec3 misplaced(const GnssAlignment& a, const SE3& T_map_enu, const Vec3& p_map) {
  return to_enu(place, map_to_geodetic(*a.georeference, p_map)) - T_map_enu.inverse() * p_map;
}

}  // namespace cambium::testing
