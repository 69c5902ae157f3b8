// SPDX-License-Identifier: BSD-3-Clause
// Iterative closest points by Gauss-Newton: pair each source patch with the nearest target patch,
// take one step on the distances of the pairs, pair again.
#pragma once
#include <optional>

#include "cambium/se3.hpp"
#include "common/surface.hpp"

namespace cambium::registration {

/// What the optimiser must keep to.
struct Stage {
  double voxel_size = 0;                   ///< of both clouds [m]
  double max_correspondence_distance = 0;  ///< [m]
  int max_iterations = 0;
  double translation_epsilon = 0;  ///< stop below this step [m]
  double rotation_epsilon = 0;     ///< [rad]
};

/// How the distance of a pair is measured.
struct Metric {
  /// Variance of a patch across itself where that along it is 1: Generalized-ICP (Segal, Haehnel,
  /// Thrun, RSS 2009). Zero: the distance to the target's plane (Chen, Medioni 1992).
  double plane_thickness = 0;
};

/// T_target_source near the guess; nothing when fewer than six patches found a counterpart.
std::optional<SE3> optimise(const Surface& target, const Patches& source, const SE3& guess,
                            const Stage& stage, const Metric& metric);

}  // namespace cambium::registration
