// SPDX-License-Identifier: BSD-3-Clause
// A stem through points around a candidate.
#pragma once
#include <Eigen/Core>
#include <numbers>
#include <optional>
#include <vector>

namespace stem_extraction {

constexpr double breast_height = 1.3;  ///< above the ground [m]

/// x, y from the candidate, z above the ground at the candidate [m].
using Points = std::vector<Eigen::Vector3d>;

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
  double taper = 0;
  double sigma = 0;     ///< of the distances of its points from the surface [m]
  int points = 0;       ///< near the surface, where it was fitted
  double coverage = 0;  ///< share of the directions around the axis that have points, 0..1

  Eigen::Vector3d axis() const { return Eigen::Vector3d(lean.x(), lean.y(), 1).normalized(); }
  /// From the axis, across.
  Eigen::Vector3d off_axis(const Eigen::Vector3d& p) const;
  /// Of a point from the surface [m], inside negative.
  double residual(const Eigen::Vector3d& p) const;
};

/// Robust least squares on the distances of points from the surface, from the stem that is given.
/// An arc of one side counts for no more than the other side, and the noise's bias of a fitted
/// radius, sigma^2 / (2 radius), is taken off (Chernov, "Circular and Linear Regression", 2010).
/// False where too few points lie on it, or where it grows out of the limits.
bool polish(const Points& points, const FitLimits& limits, int iterations, Stem& stem);

/// The lean from the points near a line through the candidate, a circle across it by random
/// sampling, polished. Nothing where no circle holds. `points` in an order that does not depend on
/// the input's; `seed` names the random samples.
std::optional<Stem> fit_stem(const Points& points, const FitLimits& limits, std::uint64_t seed);

}  // namespace stem_extraction
