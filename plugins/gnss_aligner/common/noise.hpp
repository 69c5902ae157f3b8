// SPDX-License-Identifier: BSD-3-Clause
// How well yaw and position are known when the errors of fixes are alike for a while.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace cambium::gnss {

/// One fix in units of its stated sigma. A fit's residual is `residual`; moving the map by one
/// metre changes an axis of it by `per_metre`, turning the map about the centre of the fixes by one
/// radian changes it by `per_radian`.
struct Whitened {
  double seconds = 0;
  double per_metre = 0;
  Eigen::Vector2d per_radian, residual;
};
using Series = std::vector<Whitened>;  ///< of one receiver, in order of time

struct Noise {
  double scale = 1;             ///< the true sigma over the stated one
  double correlation_time = 0;  ///< [s]
  double sigma_yaw = 0;         ///< [rad]; infinite when all places coincide
  double sigma_position = 0;    ///< of one horizontal axis at the centre [m]
  double effective_fixes = 0;   ///< independent fixes that would tell yaw as well
};

/// Each axis is modelled as white noise plus noise with exponential correlation (a first-order
/// Gauss-Markov process), whose time, share and size are estimated from the residuals by restricted
/// maximum likelihood: that accounts for what the fit of x, y and yaw has taken out of them. The
/// variances of the closed form follow, as the mean over the correlation times by their likelihood,
/// because a single best one understates them. Never better than independent fixes with the stated
/// sigmas would be. At least 3 fixes.
/// Patterson, Thompson, "Recovery of inter-block information", Biometrika 1971.
Noise model_noise(const std::vector<Series>& series);

}  // namespace cambium::gnss
