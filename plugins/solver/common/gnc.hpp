// SPDX-License-Identifier: BSD-3-Clause
// Graduated non-convexity with truncated least squares: H. Yang, P. Antonante, V. Tzoumas, L.
// Carlone, "Graduated Non-Convexity for Robust Spatial Perception: From Non-Minimal Solvers to
// Global Outlier Rejection", RA-L 5(2), 2020, section IV.
#pragma once
#include "common/minimizer.hpp"

namespace cambium::pose_solver {

struct GncResult {
  Minimum minimum;
  Weights weights;  ///< 0 or 1, but for what has not settled
};

/// A robust factor counts fully or not at all: not when r' Omega r ends above the chi-square
/// quantile whose probability is that of `width` sigmas in one dimension. The surrogate cost starts
/// nearly convex and ends as that truncation.
GncResult graduate(Minimizer& minimizer, const PoseGraph& graph, const std::vector<SE3>& start,
                   double width, const Limits& limits, const Context& context);

}  // namespace cambium::pose_solver
