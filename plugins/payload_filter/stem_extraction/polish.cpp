// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "circle.hpp"
#include "stem_fit.hpp"

namespace stem_extraction {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double least_sigma = 0.008, largest_sigma = 0.02;  // [m]
constexpr double largest_growth = 1.6;  // of a radius when it is fitted on rays
constexpr double spread_taper = 0.004;

/// Points within reach of the surface, the spread of their residuals, and their sectors.
struct Near {
  std::vector<const Point*> points;
  std::array<double, sectors> count{};
  double sigma = 0;
};

Near near_surface(const Points& points, const Stem& stem, double reach) {
  Near out;
  std::vector<double> size;
  for (const Point& p : points) {
    if (p.position.z() < lowest_fitted || p.position.z() > highest_fitted) continue;
    const double r = std::abs(stem.residual(p.position));
    if (r > reach) continue;
    out.points.push_back(&p);
    const Vector3d off = stem.off_axis(p.position);
    out.count[sector(off.x(), off.y())] += 1;
    size.push_back(r);
  }
  if (size.empty()) return out;
  const auto middle = size.begin() + std::ptrdiff_t(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  out.sigma = std::clamp(1.4826 * *middle, least_sigma, largest_sigma);
  return out;
}

/// How far a point lies outside the surface, and where that is measured.
struct Miss {
  double distance;   ///< [m]
  Vector2d normal;   ///< outwards, where the ray meets the surface or next to the point
  double steepness;  ///< distance changes by 1 / steepness when the surface moves by 1
};

Miss miss(const Vector2d& off, const Vector2d& ray, double radius) {
  constexpr double least = 0.24;  // of the cosine at the flank, where depth says little
  const Vector2d left(-ray.y(), ray.x());
  const double across = off.dot(left) / radius, deep = off.dot(ray);
  // A ray that passes by the stem tells its width only; one cannot end behind the axis.
  if (ray.isZero() || std::abs(across) > 0.97 || deep > 0.06)
    return {off.norm() - radius, off.normalized(), 1};
  const double cosine = std::max(least, std::sqrt(1 - across * across));
  return {-deep - cosine * radius, across * left - cosine * ray, cosine};
}

/// One Gauss-Newton step with Tukey's weights.
void refine(const Near& near, double cutoff, bool rays, Stem& stem) {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  for (const Point* p : near.points) {
    const double t = p->position.z() - breast_height, u = stem.residual(p->position) / cutoff;
    if (std::abs(u) >= 1) continue;
    const Vector2d off = stem.off_axis(p->position).head<2>();
    const auto [e, n, steepness] =
        miss(off, rays ? p->ray : Vector2d(0, 0), stem.radius + t * stem.taper);
    const double weight = std::pow(1 - u * u, 2) / (near.sigma * near.sigma);
    Vector6d J;
    J << -n, -t * n, -1, -t;
    J /= steepness;
    H += weight * J * J.transpose();
    g += weight * e * J;
  }
  H(5, 5) += 1 / (spread_taper * spread_taper);
  g[5] += (stem.taper - usual_taper) / (spread_taper * spread_taper);
  H(2, 2) += 1 / 0.01, H(3, 3) += 1 / 0.01;  // upright within 0.1, unless points say else
  g.segment<2>(2) += stem.lean / 0.01;
  H.diagonal().array() += 1.0;
  const Vector6d x = H.ldlt().solve(-g);
  stem.center += x.head<2>();
  stem.lean += x.segment<2>(2);
  stem.radius += x[4];
  stem.taper += x[5];
}

bool iterate(const Points& points, const FitLimits& limits, int iterations, bool rays, Stem& stem) {
  double reach = 0.08;
  for (int i = 0; i <= iterations; ++i) {
    const Near near = near_surface(points, stem, reach);
    if (int(near.points.size()) < limits.min_points) return false;
    stem.points = int(near.points.size());
    stem.sigma = near.sigma;
    stem.coverage = 0;
    for (const double count : near.count) stem.coverage += (count > 0) / double(sectors);
    if (i == iterations) break;
    reach = std::clamp(3 * near.sigma, 0.03, 0.06);
    refine(near, reach, rays, stem);
    if (!(stem.radius > 0.01 && stem.radius < limits.max_dbh)) return false;
  }
  return true;
}

bool fits(const FitLimits& limits, const Stem& stem) {
  const bool sized = 2 * stem.radius >= limits.min_dbh && 2 * stem.radius <= limits.max_dbh;
  return sized && stem.lean.norm() <= std::tan(limits.max_lean);
}

}  // namespace

bool polish(const Points& points, const FitLimits& limits, int iterations, Stem& stem) {
  if (!iterate(points, limits, iterations, false, stem)) return false;
  if (points.front().ray.isZero()) return fits(limits, stem);
  // Through few points of a thin stem, circles of any size fit along the rays: what grows by more
  // than a fit across the surface is biased has run away.
  Stem on_rays = stem;
  const bool holds = iterate(points, limits, iterations, true, on_rays);
  if (holds && on_rays.radius < largest_growth * stem.radius) stem = on_rays;
  return fits(limits, stem);
}

}  // namespace stem_extraction
