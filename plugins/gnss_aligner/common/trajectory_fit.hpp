// SPDX-License-Identifier: BSD-3-Clause
// Fixes over the whole path of an island: alignment, outliers and noise.
#pragma once
#include "common/noise.hpp"
#include "common/robust_fit.hpp"
#include "common/track.hpp"

namespace cambium::gnss {

struct FitSettings {
  Mounting mounting;
  double outlier_width = 3;
  double max_sigma_yaw = 10;  // [deg]

  void params(ParamVisitor& v);
};

struct TrajectoryFit {
  Tracks tracks;
  RobustFit fit;  ///< `kept` in the order of tracks.pairs()
  Noise noise;
  GnssAlignment alignment;  ///< the georeference, or why there is none
};

/// Refuses, with the figure, when fewer than 3 fixes have a place on the path or yaw is not
/// observable. Scores: "fixes" on the path, "outliers", "effective_fixes", "sigma_yaw" [rad],
/// "correlation_time" [s], "scale" of the stated sigmas, and of the fixes kept "rmse_horizontal",
/// "max_horizontal" and "rmse_vertical" [m].
TrajectoryFit fit_trajectory(const Atlas& atlas, const Island& island, const FitSettings& settings);

}  // namespace cambium::gnss
