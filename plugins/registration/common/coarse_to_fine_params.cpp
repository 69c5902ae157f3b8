// SPDX-License-Identifier: BSD-3-Clause
#include "common/coarse_to_fine.hpp"

namespace cambium::registration {

void CoarseToFine::params(ParamVisitor& v) {
  v("voxel_size", voxel_size_, "Cell of the cloud that the result is refined on", above(0.0, "m"));
  v("coarse_voxel_size", coarse_voxel_size_, "Cell of the cloud that the starts are refined on",
    above(0.0, "m"));
  v("neighbours", neighbours_, "Nearest points that a normal is fitted to", between(4, 200));
  v("max_iterations", max_iterations_, "Of the optimiser, per cloud and start", between(1, 10000));
  v("translation_epsilon", translation_epsilon_, "The optimiser stops below this step",
    above(0.0, "m"));
  v("rotation_epsilon", rotation_epsilon_, "The optimiser stops below this step",
    above(0.0, "rad"));
  v("source_points", source_points_, "At most this many points of the source are matched",
    between(100, 1e7));
  v("overlap_distance", overlap_distance_,
    "A source point with a target point within this distance counts as overlapping",
    above(0.0, "m"));
  v("min_overlap", min_overlap_, "Less overlap is no convergence", between(0.0, 1.0));
  v("max_rmse", max_rmse_, "A larger point-to-plane residual is no convergence", above(0.0, "m"));
  v("max_seen_through", max_seen_through_,
    "A larger share of standing surfaces where the other scan looks through is no convergence",
    between(0.0, 1.0));
  v("min_points", min_points_, "A thinned cloud with fewer points is not registered",
    between(10, 1e6));
  v("sigma_translation_floor", noise_.translation_floor,
    "The information matrix never claims to know the translation better", above(0.0, "m"));
  v("sigma_rotation_floor", noise_.rotation_floor,
    "The information matrix never claims to know the rotation better", above(0.0, "rad"));
  v("correlation_length", noise_.correlation_length,
    "Residuals of points nearer to each other count as one observation", above(0.0, "m"));
}

void CoarseToFine::correspondence_params(ParamVisitor& v) {
  v("max_correspondence_distance", max_correspondence_distance_,
    "Points farther apart do not pull on each other, on the fine cloud", above(0.0, "m"));
  v("coarse_correspondence_distance", coarse_correspondence_distance_,
    "The same on the coarse cloud: about the error of the best start", above(0.0, "m"));
}

std::string CoarseToFine::check_params() const {
  if (coarse_voxel_size_ < voxel_size_) return "coarse_voxel_size must be at least voxel_size";
  if (coarse_correspondence_distance_ < max_correspondence_distance_)
    return "coarse_correspondence_distance must be at least max_correspondence_distance";
  if (neighbours_ > min_points_) return "neighbours must be at most min_points";
  return {};
}

}  // namespace cambium::registration
