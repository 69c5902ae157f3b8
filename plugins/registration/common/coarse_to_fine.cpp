// SPDX-License-Identifier: BSD-3-Clause
#include "common/coarse_to_fine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace cambium::registration {
namespace {

// "overlap 0.31 is below min_overlap 0.50"
std::string compare(const char* what, double found, const char* relation, double limit) {
  char text[120];
  std::snprintf(text, sizeof text, "%s %.3g is %s %.3g", what, found, relation, limit);
  return text;
}

std::string too_few(const char* which, std::size_t found, int needed) {
  return std::string(which) + " has " + std::to_string(found) + " points after thinning, needs " +
         std::to_string(needed) + " (min_points)";
}

constexpr int coarse_source_points = 2000;  // the start need not be better
constexpr std::size_t probe_points = 4000;  // more do not change the judgement

bool enough(const Level& level, int needed) { return level.surface.size() >= std::size_t(needed); }

// Both ways: either scan may see through what the other one found.
Sight sight_of(const PreparedCloud& target, const PreparedCloud& source, const SE3& T) {
  Sight sight = look(target.sight, source.coarse.probe, T);
  sight += look(source.sight, target.coarse.probe, T.inverse());
  return sight;
}

}  // namespace

Level CoarseToFine::make_level(const Thinned& cloud, int source_points) const {
  Level level;
  level.surface = make_surface(cloud, neighbours_);
  level.sample = sample(level.surface.patches, std::size_t(source_points));
  level.probe = sample(level.surface.patches, probe_points);
  const auto probes = double(std::max<std::size_t>(level.probe.size(), 1));
  level.spacing = cloud.voxel_size * std::sqrt(double(level.surface.size()) / probes);
  if (level.surface.size() >= std::size_t(min_points_)) extend(level, cloud.voxel_size);
  return level;
}

Prepared CoarseToFine::prepare(const Payload& payload, const Context& context) const {
  context.check_cancelled();
  const Cloud none;
  const Cloud& cloud = payload.cloud ? *payload.cloud : none;
  const Thinned fine = thin(cloud, voxel_size_);
  auto prepared = std::make_shared<PreparedCloud>(
      PreparedCloud{make_level(thin(fine.points, coarse_voxel_size_),
                               std::min(source_points_, coarse_source_points)),
                    make_level(fine, source_points_), RangeImage(cloud), nullptr, 0});
  if (enough(prepared->coarse, min_points_)) extend(*prepared);
  std::size_t bytes = sizeof(PreparedCloud) + prepared->sight.bytes() + prepared->extra_bytes;
  for (const Level* level : {&prepared->coarse, &prepared->fine})
    bytes += level->surface.bytes() + level->extra_bytes +
             (level->sample.size() + level->probe.size()) * sizeof(Patch);
  return {payload, prepared, bytes};
}

std::optional<SE3> CoarseToFine::best_coarse(const PreparedCloud& target,
                                             const PreparedCloud& source, const SE3& guess,
                                             const Context& context) const {
  const Stage stage{coarse_voxel_size_, coarse_correspondence_distance_, max_iterations_,
                    10 * translation_epsilon_, 10 * rotation_epsilon_};
  std::optional<SE3> best;
  double best_score = -1;
  for (const SE3& start : starts(target, source, guess)) {
    context.check_cancelled();
    const std::optional<SE3> T = refine(target.coarse, source.coarse, start, stage);
    if (!T || !T->finite()) continue;
    const double overlap =
        evaluate(target.coarse.surface, source.coarse.probe, *T, coarse_voxel_size_).overlap;
    const double score = overlap * (1 - sight_of(target, source, *T).share());
    if (score > best_score) {
      best_score = score;
      best = T;
    }
  }
  return best;
}

void CoarseToFine::judge(const PreparedCloud& target, const PreparedCloud& source,
                         Alignment& alignment) const {
  const SE3& T = alignment.T_target_source;
  const Quality quality = evaluate(target.fine.surface, source.fine.probe, T, overlap_distance_);
  const double seen_through = sight_of(target, source, T).share();
  NoiseModel noise = noise_;
  noise.spacing = source.fine.spacing;
  alignment.information = information(quality, noise);
  alignment.scores = {{"overlap", quality.overlap},
                      {"inliers", quality.inlier_share},
                      {"rmse", quality.rmse},
                      {"seen_through", seen_through}};
  const Vec6 sigma = sigmas(alignment.information);
  constexpr std::array axes = {"sigma_x",    "sigma_y",     "sigma_z",
                               "sigma_roll", "sigma_pitch", "sigma_yaw"};
  for (std::size_t i = 0; i < axes.size(); ++i)
    alignment.scores.push_back({axes[i], sigma[Eigen::Index(i)]});
  if (quality.overlap < min_overlap_)
    alignment.reason = compare("overlap", quality.overlap, "below min_overlap", min_overlap_);
  else if (quality.rmse > max_rmse_)
    alignment.reason = compare("rmse", quality.rmse, "above max_rmse", max_rmse_);
  else if (seen_through > max_seen_through_)
    alignment.reason =
        compare("seen_through", seen_through, "above max_seen_through", max_seen_through_);
  alignment.converged = alignment.reason.empty();
}

Alignment CoarseToFine::align(const Prepared& target, const Prepared& source,
                              const SE3& T_target_source_guess, const Context& context) const {
  const auto& t = *static_cast<const PreparedCloud*>(target.data.get());
  const auto& s = *static_cast<const PreparedCloud*>(source.data.get());
  Alignment alignment;
  alignment.T_target_source = T_target_source_guess;
  if (!T_target_source_guess.finite())
    alignment.reason = "the guess is not finite";
  else if (!enough(t.coarse, min_points_))
    alignment.reason = too_few("target", t.coarse.surface.size(), min_points_);
  else if (!enough(s.coarse, min_points_))
    alignment.reason = too_few("source", s.coarse.surface.size(), min_points_);
  if (!alignment.reason.empty()) return alignment;

  std::optional<SE3> T = best_coarse(t, s, T_target_source_guess, context);
  if (T)
    T = refine(t.fine, s.fine, *T,
               {voxel_size_, max_correspondence_distance_, max_iterations_, translation_epsilon_,
                rotation_epsilon_});
  if (!T || !T->finite()) {
    alignment.reason = "the optimiser found no step: too few correspondences near the guess";
    return alignment;
  }
  alignment.T_target_source = *T;
  judge(t, s, alignment);
  return alignment;
}

}  // namespace cambium::registration
