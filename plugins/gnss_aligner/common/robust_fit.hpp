// SPDX-License-Identifier: BSD-3-Clause
// Yaw and translation between fixes and a path when some of the fixes are wrong.
#pragma once
#include "common/fixes.hpp"

namespace cambium::gnss {

struct RobustFit {
  SE3 T_map_enu;
  std::vector<bool> kept;  ///< per pair; the others are outliers
  double scale = 1;        ///< the residuals over their stated sigma, at least 1
};

/// The weighted closed form (Umeyama 1991 in the plane) inside graduated non-convexity with
/// truncated least squares (Yang et al., RA-L 2020, equation 14), started from the fit with the
/// least median residual over hypotheses from two places each (Rousseeuw 1984): right with up to
/// half of the fixes wrong. Only the horizontal counts; a fix is an outlier beyond `width` sigmas
/// of a normal distribution, of the stated sigma or, where the median residual says that it is too
/// small, of a larger one. Height is the weighted median of the fixes kept. At least 2 pairs.
RobustFit robust_fit(const std::vector<Pair>& pairs, double width);

}  // namespace cambium::gnss
