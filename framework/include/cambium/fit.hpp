// SPDX-License-Identifier: BSD-3-Clause
// Closed-form fits between corresponding points: for georeferencing and for trajectory errors.
#pragma once
#include <span>

#include "cambium/se3.hpp"

namespace cambium {

/// Yaw and translation T_target_source that minimise sum w |target - T_target_source * source|^2:
/// for frames whose z axes are both vertical. Umeyama's solution (PAMI 1991) in the plane, without
/// scale; z is the weighted mean difference. `weights` has one positive number per pair, or is
/// empty (all 1). Yaw is 0 when the points do not determine it. Throws Error(numeric) without
/// pairs.
SE3 fit_yaw(std::span<const Vec3> target, std::span<const Vec3> source,
            std::span<const double> weights = {});

/// The same over all rotations (Umeyama 1991 without scale).
SE3 fit_rigid(std::span<const Vec3> target, std::span<const Vec3> source);

}  // namespace cambium
