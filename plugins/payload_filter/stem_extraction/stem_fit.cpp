// SPDX-License-Identifier: BSD-3-Clause
#include "stem_fit.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "circle.hpp"

namespace stem_extraction {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Where a line through the candidate goes: (x, y) per metre of height, by Cauchy weights whose
/// scale falls. Heights count alike, however many points they have.
Vector2d lean_of(const Points& points, double max_lean) {
  constexpr double bin = 0.25;
  std::array<double, 32> count{};
  const auto bin_of = [&](const Vector3d& p) { return std::size_t(p.z() / bin); };
  const auto used = [](const Vector3d& p) { return p.z() > lowest_fitted && p.z() < 4.0; };
  for (const auto& [p, ray] : points)
    if (used(p) && p.head<2>().norm() < 0.3) count[bin_of(p)] += 1;
  Vector2d at(0, 0), lean(0, 0);
  for (double scale = 0.15; scale > 0.05; scale *= 0.8) {
    Eigen::Matrix2d H =
        Eigen::Vector2d(1e-6, 0.05).asDiagonal();  // upright, unless points say else
    Eigen::Matrix2d b = Eigen::Matrix2d::Zero();
    for (const auto& [p, ray] : points) {
      if (!used(p) || count[bin_of(p)] == 0) continue;
      const Vector2d J(1, p.z() - breast_height);
      const double r = (p.head<2>() - at - J.y() * lean).norm() / scale;
      const double weight = 1 / ((1 + r * r) * (1 + r * r) * count[bin_of(p)]);
      H += weight * J * J.transpose();
      b += weight * J * p.head<2>().transpose();
    }
    const Eigen::Matrix2d x = H.ldlt().solve(b);
    at = x.row(0);
    lean = x.row(1);
  }
  const double largest = std::tan(max_lean);
  return lean.norm() > largest ? Vector2d(lean * largest / lean.norm()) : lean;
}

}  // namespace

Vector3d Stem::off_axis(const Vector3d& p) const {
  const Vector3d d = p - Vector3d(center.x(), center.y(), breast_height), a = axis();
  return d - d.dot(a) * a;
}

double Stem::residual(const Vector3d& p) const {
  return off_axis(p).norm() - radius - taper * (p.z() - breast_height);
}

std::optional<Stem> fit_stem(const Points& all, const FitLimits& limits, std::uint64_t seed) {
  Points points;
  for (const Point& p : all)
    if (p.position.z() > lowest_fitted && p.position.z() < 4.0) points.push_back(p);
  Stem stem;
  stem.lean = lean_of(points, limits.max_lean);
  std::vector<Vector2d> across;
  for (const double half : {0.7, 1.2}) {
    across.clear();
    for (const auto& [p, ray] : points)
      if (std::abs(p.z() - breast_height) < half)
        across.push_back(p.head<2>() - (p.z() - breast_height) * stem.lean);
    if (across.size() >= 3u * std::size_t(limits.min_points)) break;
  }
  const auto circle = sample_circle(across, limits.min_dbh / 2, limits.max_dbh / 2, seed);
  if (!circle) return std::nullopt;
  stem.center = circle->center;
  stem.radius = circle->radius;
  if (!polish(points, limits, 8, stem)) return std::nullopt;
  return stem;
}

}  // namespace stem_extraction
