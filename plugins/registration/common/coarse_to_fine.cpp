// SPDX-License-Identifier: BSD-3-Clause
#include "common/coarse_to_fine.hpp"

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

}  // namespace

Level CoarseToFine::make_level(const Thinned& cloud) const {
  Level level;
  level.surface = make_surface(cloud, neighbours_);
  level.sample = sample(level.surface.patches, std::size_t(source_points_));
  level.spacing = cloud.voxel_size * std::sqrt(double(level.surface.size()) /
                                               double(std::max<std::size_t>(level.sample.size(), 1)));
  if (level.surface.size() >= std::size_t(min_points_)) extend(level, cloud.voxel_size);
  return level;
}

Prepared CoarseToFine::prepare(const Payload& payload, const Context& context) const {
  context.check_cancelled();
  auto prepared = std::make_shared<PreparedCloud>();
  const Cloud none;
  const Cloud& cloud = payload.cloud ? *payload.cloud : none;
  const Thinned fine = thin(cloud, voxel_size_);
  prepared->fine = make_level(fine);
  prepared->coarse = make_level(thin(fine.points, coarse_voxel_size_));
  std::size_t bytes = sizeof(PreparedCloud);
  for (const Level* level : {&prepared->coarse, &prepared->fine})
    bytes += level->surface.bytes() + level->sample.size() * sizeof(Patch) + level->extra_bytes;
  return {payload, prepared, bytes};
}

std::optional<SE3> CoarseToFine::best_coarse(const PreparedCloud& target,
                                             const PreparedCloud& source, const SE3& guess,
                                             const Context& context) const {
  const SearchWindow window{search_radius_, search_height_, search_yaw_,
                            search_step_,   0.05,           hypotheses_};
  const Stage stage{coarse_voxel_size_, coarse_correspondence_distance_, max_iterations_,
                    10 * translation_epsilon_, 10 * rotation_epsilon_};
  std::optional<SE3> best;
  double best_overlap = -1;
  for (const SE3& start : search(target.coarse.surface, source.coarse.sample, guess, window)) {
    context.check_cancelled();
    const std::optional<SE3> T = refine(target.coarse, source.coarse, start, stage);
    if (!T || !T->finite()) continue;
    const double overlap =
        evaluate(target.coarse.surface, source.coarse.sample, *T, coarse_voxel_size_).overlap;
    if (overlap > best_overlap) {
      best_overlap = overlap;
      best = T;
    }
  }
  return best;
}

void CoarseToFine::judge(const Level& target, const Level& source, Alignment& alignment) const {
  const Quality quality =
      evaluate(target.surface, source.sample, alignment.T_target_source, overlap_distance_);
  alignment.scores = {{"overlap", quality.overlap}, {"rmse", quality.rmse}};
  alignment.information = information(quality, {sigma_translation_floor_, sigma_rotation_floor_,
                                                correlation_length_, source.spacing});
  if (quality.overlap < min_overlap_)
    alignment.reason = compare("overlap", quality.overlap, "below min_overlap", min_overlap_);
  else if (quality.rmse > max_rmse_)
    alignment.reason = compare("rmse", quality.rmse, "above max_rmse", max_rmse_);
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
  else if (t.coarse.surface.size() < std::size_t(min_points_))
    alignment.reason = too_few("target", t.coarse.surface.size(), min_points_);
  else if (s.coarse.surface.size() < std::size_t(min_points_))
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
  judge(t.fine, s.fine, alignment);
  return alignment;
}

}  // namespace cambium::registration
