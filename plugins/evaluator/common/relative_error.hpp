// SPDX-License-Identifier: BSD-3-Clause
// The error of a relative pose, as every evaluator states it.
#pragma once
#include <numbers>

#include "cambium/se3.hpp"

namespace cambium::evaluator {

constexpr double degree = std::numbers::pi / 180;

struct RelativeError {
  double translation;  ///< [m]
  double rotation;     ///< [deg]
};

/// Of an estimated T_a_b against the true one: E = T_true^-1 T_estimated (Sturm et al., "A
/// benchmark for the evaluation of RGB-D SLAM systems", IROS 2012, eq. 1).
inline RelativeError relative_error(const SE3& T_a_b_true, const SE3& T_a_b_estimated) {
  const SE3 error = T_a_b_true.inverse() * T_a_b_estimated;
  return {error.t.norm(), rotation_angle(error) / degree};
}

}  // namespace cambium::evaluator
