// SPDX-License-Identifier: BSD-3-Clause
// How well two surfaces lie on each other: the judgement that does not come from the optimiser.
#pragma once
#include "cambium/se3.hpp"
#include "common/surface.hpp"

namespace cambium::registration {

struct Quality {
  std::size_t inliers = 0;  ///< source points with a target point within the distance
  double overlap = 0;       ///< their share of the source, 0..1
  double rmse = 0;          ///< of their distances to the target's tangent planes [m]
  double inlier_share = 0;  ///< of those, the share nearer to the plane than 0.1 m
  /// Sum of J'J of those distances, J = n' [I, -R [p]x]: the normal equations in the tangent of
  /// pose_graph.hpp's residual with tail = target and head = source (translation in the target's
  /// axes, rotation in the source's).
  Mat6 normal_equations = Mat6::Zero();
};

Quality evaluate(const Surface& target, const Patches& source, const SE3& T_target_source,
                 double distance);

struct NoiseModel {
  double translation_floor = 0.03;  ///< [m]
  double rotation_floor = 0.007;    ///< [rad]
  double correlation_length = 1.85;  ///< residuals nearer to each other are one observation [m]
  double spacing = 0.3;             ///< of the points that were evaluated [m]
};

/// Information of (translation; rotation): residual variance and normal equations, the number of
/// points cut to that of independent patches, then added to the floor as a second, independent
/// error. Symmetric positive definite; directions that nothing holds come out weak (30 m, or 30 m
/// times the ratio of the floors), not singular.
Mat6 information(const Quality& quality, const NoiseModel& noise);

/// Standard deviations (translation [m]; rotation [rad]) along the axes: what the scans say about
/// each.
Vec6 sigmas(const Mat6& information);

}  // namespace cambium::registration
