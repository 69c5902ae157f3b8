// SPDX-License-Identifier: BSD-3-Clause
#include "common/trajectory_fit.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::gnss {
namespace {

struct Centre {
  Vec3 p_map = Vec3::Zero();  // of the fixes kept, weighted by their variance
  double reach = 0;           // root mean square distance from it [m]
};

Centre centre_of(const std::vector<Pair>& pairs, const std::vector<bool>& kept) {
  Centre out;
  double total = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!kept[i]) continue;
    const double w = 1 / horizontal_variance(pairs[i].covariance);
    out.p_map += w * pairs[i].p_map;
    total += w;
  }
  out.p_map /= total;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!kept[i]) continue;
    squares += (pairs[i].p_map - out.p_map).head<2>().squaredNorm();
    ++count;
  }
  out.reach = std::sqrt(squares / count);
  return out;
}

Whitened whitened(const Measurement& m, const SE3& T_map_enu, const Vec3& centre_map) {
  const double sigma = std::sqrt(horizontal_variance(m.pair.covariance));
  const Vec3 residual = m.pair.p_map - T_map_enu * m.pair.p_enu, lever = m.pair.p_map - centre_map;
  return {m.seconds, 1 / sigma, Eigen::Vector2d(-lever.y(), lever.x()) / sigma,
          Eigen::Vector2d(residual.head<2>()) / sigma};
}

std::vector<Series> series_of(const Tracks& tracks, const RobustFit& fit, const Vec3& centre_map) {
  std::vector<Series> out;
  std::size_t i = 0;
  for (const Track& track : tracks.tracks) {
    Series series;
    for (const Measurement& m : track.measurements)
      if (fit.kept[i++]) series.push_back(whitened(m, fit.T_map_enu, centre_map));
    if (!series.empty()) out.push_back(std::move(series));
  }
  return out;
}

void add_residual_scores(const std::vector<Pair>& pairs, const RobustFit& fit,
                         std::vector<Score>& scores) {
  double horizontal = 0, vertical = 0, largest = 0, count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (!fit.kept[i]) continue;
    const Vec3 r = pairs[i].p_map - fit.T_map_enu * pairs[i].p_enu;
    horizontal += r.head<2>().squaredNorm();
    vertical += r.z() * r.z();
    largest = std::max(largest, r.head<2>().norm());
    ++count;
  }
  scores.insert(scores.end(), {{"rmse_horizontal", std::sqrt(horizontal / count)},
                               {"max_horizontal", largest},
                               {"rmse_vertical", std::sqrt(vertical / count)}});
}

std::string why_not(const TrajectoryFit& f, double reach, double max_sigma_yaw) {
  return "yaw is known to " + number(f.noise.sigma_yaw / degree) + " deg only, allowed are " +
         number(max_sigma_yaw) + " (max_sigma_yaw): " + number(f.noise.effective_fixes) +
         " independent fixes reach " + number(reach) +
         " m around their centre; record a longer path, or with a better receiver";
}

void judge(const Centre& centre, double max_sigma_yaw, TrajectoryFit& f) {
  const auto pairs = f.tracks.pairs();
  const auto outliers = std::count(f.fit.kept.begin(), f.fit.kept.end(), false);
  auto& scores = f.alignment.scores;
  scores = {{"fixes", double(pairs.size())},
            {"outliers", double(outliers)},
            {"effective_fixes", f.noise.effective_fixes},
            {"sigma_yaw", f.noise.sigma_yaw},
            {"correlation_time", f.noise.correlation_time},
            {"scale", f.noise.scale}};
  add_residual_scores(pairs, f.fit, scores);
  // Written so that it is also refused when yaw is not determined at all.
  if (!(f.noise.sigma_yaw <= max_sigma_yaw * degree)) {
    f.alignment.reason = why_not(f, centre.reach, max_sigma_yaw);
    return;
  }
  const Geodetic& at = f.tracks.reference;
  f.alignment.georeference =
      GeoReference{at.latitude,     at.longitude,      at.altitude,
                   f.fit.T_map_enu, f.noise.sigma_yaw, f.noise.sigma_position};
}

}  // namespace

void FitSettings::params(ParamVisitor& v) {
  mounting.params(v);
  v("outlier_width", outlier_width,
    "Fixes farther off than so many sigmas are outliers; more keeps more of them", above(0));
  v("max_sigma_yaw", max_sigma_yaw, "Refuse when yaw is known worse than this", above(0, "deg"));
}

TrajectoryFit fit_trajectory(const Atlas& atlas, const Island& island,
                             const FitSettings& settings) {
  TrajectoryFit out;
  out.tracks = find_tracks(atlas, island, settings.mounting);
  const std::vector<Pair> pairs = out.tracks.pairs();
  if (pairs.size() < 3) {
    out.alignment.reason =
        std::to_string(pairs.size()) + " of " + std::to_string(out.tracks.fixes) +
        " GNSS fixes lie between nodes at most " + number(settings.mounting.max_gap) +
        " s apart, at least 3 are needed; record more fixes or raise max_gap";
    return out;
  }
  out.fit = robust_fit(pairs, settings.outlier_width);
  if (std::count(out.fit.kept.begin(), out.fit.kept.end(), true) < 3) {
    out.alignment.reason = "no three of " + std::to_string(pairs.size()) +
                           " GNSS fixes agree with the path; are the stamps of both in one clock?";
    return out;
  }
  const Centre centre = centre_of(pairs, out.fit.kept);
  out.noise = model_noise(series_of(out.tracks, out.fit, centre.p_map));
  judge(centre, settings.max_sigma_yaw, out);
  return out;
}

}  // namespace cambium::gnss
