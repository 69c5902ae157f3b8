// SPDX-License-Identifier: BSD-3-Clause
#include "gnss_data.hpp"

#include <algorithm>
#include <limits>
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fit.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"
#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

/// 3 m: what a receiver without corrections is good for; the sets do not say.
GnssFix fix_at(std::size_t i, const Geodetic& g) {
  return {Stamp{std::int64_t(i), 0}, g.latitude, g.longitude, g.altitude,
          Mat3(Vec3(9, 9, 36).asDiagonal())};
}

Mission mission_of(const std::string& name, const std::vector<SE3>& poses,
                   const std::vector<Geodetic>& places) {
  Mission mission = make_mission(name, poses);
  for (std::size_t i = 0; i < places.size(); ++i) mission.fixes.push_back(fix_at(i, places[i]));
  return mission;
}

Vec3 nearest_on(const Vec3& a, const Vec3& b, const Vec3& p) {
  const Vec3 ab = b - a;
  const double length = ab.squaredNorm();
  return a + (length > 0 ? std::clamp((p - a).dot(ab) / length, 0.0, 1.0) : 0.0) * ab;
}

/// For each pose its place on the track: first at its share of the length, then, five times, the
/// nearest within 60 m along the track of that, after a fit.
std::vector<Vec3> beside(const std::vector<SE3>& poses, const std::vector<SE3>& track) {
  const auto along = travelled(make_mission("", poses)),
             reference = travelled(make_mission("", track));
  std::vector<Vec3> mapped, places(poses.size());
  for (const SE3& T : poses) mapped.push_back(T.t);
  for (int round = 0; round < 6; ++round) {
    const SE3 T_map_enu = round == 0 ? SE3{} : fit_yaw(mapped, places);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double wanted = along[i] / along.back() * reference.back();
      const Vec3 p_enu = T_map_enu.inverse() * mapped[i];
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k + 1 < track.size(); ++k) {
        const double off = std::max({reference[k] - wanted, wanted - reference[k + 1], 0.0});
        if (off > (round == 0 ? 0 : 60)) continue;
        const Vec3 q = nearest_on(track[k].t, track[k + 1].t, Vec3(p_enu.x(), p_enu.y(), 0));
        const double distance = round == 0 ? off : (q - p_enu).head<2>().norm();
        if (distance < best) best = distance, places[i] = q;
      }
    }
  }
  return places;
}

}  // namespace

Mission race_track(const std::filesystem::path& gnss) {
  const auto folder = gnss / "gnss_a2rl_flexcloud";
  std::istringstream fixes(read_file(folder / "positions_interpolated.txt")),
      rows(read_file(folder / "poses_keyframes.txt"));
  std::vector<SE3> poses;
  std::vector<Geodetic> places;
  double stamp, unused;
  Vec3 p;
  SE3 T;
  while (fixes >> stamp >> p.x() >> p.y() >> p.z() >> unused >> unused >> unused &&
         rows >> stamp >> T.t.x() >> T.t.y() >> T.t.z() >> T.q.x() >> T.q.y() >> T.q.z() >>
             T.q.w()) {
    poses.push_back(T);
    places.push_back(from_enu({24.47, 54.6, 0}, p));
  }
  return mission_of("race_track", poses, places);
}

Mission munich(const std::filesystem::path& gnss) {
  const auto folder = gnss / "gnss_munich_route1";
  std::istringstream rows(read_file(folder / "route1_pose_kitti.txt")),
      lines(read_file(folder / "route_1_GPS.txt"));
  std::vector<SE3> poses, track;
  Mat4 M = Mat4::Identity();
  while (rows >> M(0, 0) >> M(0, 1) >> M(0, 2) >> M(0, 3) >> M(1, 0) >> M(1, 1) >> M(1, 2) >>
         M(1, 3) >> M(2, 0) >> M(2, 1) >> M(2, 2) >> M(2, 3))
    poses.push_back(SE3::from_matrix(M));
  Geodetic g, first;
  while (lines >> g.latitude >> g.longitude) {
    if (track.empty()) first = g;
    track.push_back({Quat::Identity(), to_enu(first, g)});
  }
  std::vector<Geodetic> places;
  for (const Vec3& p_enu : beside(poses, track)) places.push_back(from_enu(first, p_enu));
  return mission_of("munich", poses, places);
}

Mission hdl_from_edges(const std::filesystem::path& file) {
  const Mission graph = read_g2o(file);
  Mission edges = graph;
  std::erase_if(edges.edges, [](const Edge& e) { return e.kind == EdgeKind::position; });
  const auto poses = component<Solver>("sparse_lm", "{loss: cauchy}")
                         ->solve(pose_graph_from(edges), *make_context())
                         .T_map_node;
  const Geodetic indiana{39.8125, -86.3415, 261};
  std::vector<SE3> at_priors;
  std::vector<Geodetic> places;
  for (const Edge& e : graph.edges) {
    if (e.kind != EdgeKind::position) continue;
    at_priors.push_back(poses[*graph.index_of(e.head)]);
    places.push_back(from_enu(indiana, e.T_tail_head.t));
  }
  return mission_of("hdl", at_priors, places);
}

}  // namespace cambium::testing
