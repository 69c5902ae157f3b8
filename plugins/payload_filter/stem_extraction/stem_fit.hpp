// SPDX-License-Identifier: BSD-3-Clause
// A stem through points around a candidate.
#pragma once
#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <vector>

namespace stem_extraction {

constexpr double breast_height = 1.3;                        ///< above the ground [m]
constexpr double lowest_fitted = 0.5, highest_fitted = 3.0;  ///< of the points that count [m]
/// Of the radius a metre of height: Scots pines and spruces lose about a centimetre of diameter a
/// metre around breast height.
constexpr double usual_taper = -0.006;

struct Point {
  Eigen::Vector3d position;   ///< x, y from the candidate, z above the ground there [m]
  Eigen::Vector2d ray{0, 0};  ///< from the sensor, unit length; zero where that is not known
};
using Points = std::vector<Point>;

struct FitLimits {
  double min_dbh = 0.05, max_dbh = 0.8;  ///< [m]
  double max_lean = 0.35;                ///< from the vertical [rad]
  int min_points = 12;                   ///< on the stem, between half a metre and max_fit_height
};

/// A tapered stem: distance from the axis = radius + taper * (z - breast height).
struct Stem {
  Eigen::Vector2d center{0, 0};  ///< of the axis at breast height
  Eigen::Vector2d lean{0, 0};    ///< how far the axis moves on a metre of height
  double radius = 0;             ///< at breast height [m]
  double taper = usual_taper;
  double sigma = 0;     ///< of the distances of its points from the surface [m]
  int points = 0;       ///< near the surface, where it was fitted
  double coverage = 0;  ///< share of the directions around the axis that have points, 0..1

  Eigen::Vector3d axis() const { return Eigen::Vector3d(lean.x(), lean.y(), 1).normalized(); }
  /// From the axis, across.
  Eigen::Vector3d off_axis(const Eigen::Vector3d& p) const;
  /// Of a point from the surface [m], inside negative.
  double residual(const Eigen::Vector3d& p) const;
};

/// Robust least squares from the stem that is given. Where rays are known, on the distances along
/// them: the noise of a lidar is in the range, and a fit on distances across the surface makes
/// stems too thin that are seen from one side only. Else on the distances across the surface.
/// False where too few points lie on it, or where it grows out of the limits.
bool polish(const Points& points, const FitLimits& limits, int iterations, Stem& stem);

/// The lean from the points near a line through the candidate, a circle across it by random
/// sampling, polished. Nothing where no circle holds. `points` in an order that does not depend on
/// the input's; `seed` names the random samples.
std::optional<Stem> fit_stem(const Points& points, const FitLimits& limits, std::uint64_t seed);

}  // namespace stem_extraction
