// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

namespace scan_context {

/// Horizontal offsets of viewpoints from the base [m]: a square grid of `step` within `radius`, the
/// base itself first. A radius below the step gives the base alone.
std::vector<Eigen::Vector2f> viewpoints(double radius, double step);

}  // namespace scan_context
