// SPDX-License-Identifier: BSD-3-Clause
// Brings the map of one survey onto that of another: by GNSS, then by the trees that both know.
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <tuple>

#include "cambium/error.hpp"
#include "cambium/fit.hpp"
#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"
#include "monitor/changes.hpp"

namespace cambium::monitor {
namespace {

constexpr double search = 10;                   // what GNSS under a canopy may be off [m]
constexpr double vote_cell = 0.5;               // [m]
constexpr double most_yaw = 6, yaw_step = 0.5;  // [deg]
constexpr double same_dbh = 0.06;               // diameters of one tree differ by less [m]
constexpr std::size_t fewest = 8;               // trees that a map must share to be moved by them
constexpr double least_share = 0.3;  // of those around which the other map has trees; chance: 0.08

std::vector<Vec3> places(const std::vector<Stem>& stems, const SE3& T) {
  std::vector<Vec3> out;
  for (const Stem& s : stems) out.push_back(T * s.base);
  return out;
}

/// Through the globe. Two tangent planes are related by a rigid motion.
SE3 by_gnss(const Survey& before, const Survey& after) {
  const auto reference = [](const Survey& s) {
    const std::uint32_t island = island_of(s);
    if (const auto g = georeference(s.clouds, s.clouds.islands[island])) return *g;
    throw Error(ErrorCode::config, s.name,
                "has no georeference, so it has no frame in common with the other survey; fuse the "
                "missions in one run and name them RUN:MISSION, or add a georeference step");
  };
  const GeoReference a = reference(before), b = reference(after);
  std::vector<Vec3> in_a, in_b;
  for (int k = 0; k < 4; ++k) {
    const Vec3 p = k == 0 ? Vec3(Vec3::Zero()) : Vec3(100 * Vec3::Unit(k - 1));
    in_b.push_back(p);
    in_a.push_back(a.T_map_enu *
                   to_enu({a.latitude, a.longitude, a.altitude}, map_to_geodetic(b, p)));
  }
  return fit_rigid(in_a, in_b);
}

/// The yaw and shift that the most pairs of trees of like diameter agree on.
SE3 by_votes(const std::vector<Stem>& before, const std::vector<Stem>& after, const SE3& T_guess) {
  Vec3 middle = Vec3::Zero();
  const auto b = places(after, T_guess);
  for (const Vec3& p : b) middle += p / double(b.size());
  std::tuple<std::size_t, SE3> best{0, T_guess};
  for (double degrees = -most_yaw; degrees <= most_yaw; degrees += yaw_step) {
    const SE3 turn = SE3::from_yaw(degrees * M_PI / 180);
    std::map<std::pair<int, int>, std::size_t> votes;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const Vec3 p = middle + turn * Vec3(b[j] - middle);
      for (const Stem& s : before) {
        const Vec3 d = s.base - p;
        if (std::max(std::abs(d.x()), std::abs(d.y())) > search) continue;
        if (std::abs(s.dbh - after[j].dbh) > same_dbh) continue;
        const std::pair cell{int(std::floor(d.x() / vote_cell)),
                             int(std::floor(d.y() / vote_cell))};
        if (++votes[cell] <= std::get<0>(best)) continue;
        const Vec3 shift((cell.first + 0.5) * vote_cell, (cell.second + 0.5) * vote_cell, 0);
        const SE3 T_turned{turn.q, middle + shift - turn * middle};
        best = {votes[cell], T_turned * T_guess};
      }
    }
  }
  return std::get<1>(best);
}

}  // namespace

void align(const Survey& before, const Survey& after, const std::vector<Stem>& stems_before,
           const std::vector<Stem>& stems_after, Changes& out) {
  const bool one_map = !before.run.empty() && before.run == after.run;
  if (one_map && island_of(before) == island_of(after)) return;
  const SE3 T_guess = by_gnss(before, after);
  if (stems_before.empty() || stems_after.empty()) {
    out.T_before_after = T_guess;
    return;
  }
  SE3 T = by_votes(stems_before, stems_after, T_guess);
  const auto a = places(stems_before, {});
  std::vector<Vec3> at_a, at_b;
  for (const double radius : {1.5, 1.0, 0.75, 0.5, 0.5, 0.5, 0.5, 0.5}) {
    at_a.clear(), at_b.clear();
    for (const auto& [i, j] : mutual_nearest(a, places(stems_after, T), radius)) {
      at_a.push_back(stems_before[i].base);
      at_b.push_back(stems_after[j].base);
    }
    if (at_a.size() < fewest) break;
    T = fit_yaw(at_a, at_b);
  }
  const std::size_t around = mutual_nearest(a, places(stems_after, T), 4).size();
  if (at_a.size() < fewest || double(at_a.size()) < least_share * double(around))
    throw Error(
        ErrorCode::check, after.name,
        fmt::format("only {} of {} trees agree with those of '{}' within {} m of where GNSS "
                    "puts them; do the surveys overlap?",
                    at_a.size(), around, before.name, search));
  double sum = 0;
  for (std::size_t k = 0; k < at_a.size(); ++k)
    sum += (at_a[k] - T * at_b[k]).head<2>().squaredNorm();
  out.T_before_after = T;
  out.aligned_by = at_a.size();
  out.aligned_rms = std::sqrt(sum / double(at_a.size()));
}

}  // namespace cambium::monitor
