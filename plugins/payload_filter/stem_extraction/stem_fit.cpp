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
using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

constexpr double lowest = 0.5, highest = 3.0;  // of what is fitted, above the ground [m]
constexpr double least_sigma = 0.008, largest_sigma = 0.02;  // [m]
// Radius a metre of height, mean and spread: Scots pines and spruces lose about a centimetre of
// diameter a metre around breast height.
constexpr double usual_taper = -0.006, spread_taper = 0.004;

std::size_t sector_of(const Vector3d& off) { return sector(off.x(), off.y()); }

/// Where a line through the candidate goes: (x, y) per metre of height, by Cauchy weights whose
/// scale falls. Heights count alike, however many points they have.
Vector2d lean_of(const Points& points, double max_lean) {
  constexpr double bin = 0.25;
  std::array<double, 32> count{};
  const auto bin_of = [&](const Vector3d& p) { return std::size_t(p.z() / bin); };
  const auto used = [](const Vector3d& p) { return p.z() > lowest && p.z() < 4.0; };
  for (const Vector3d& p : points)
    if (used(p) && p.head<2>().norm() < 0.3) count[bin_of(p)] += 1;
  Vector2d at(0, 0), lean(0, 0);
  for (double scale = 0.15; scale > 0.05; scale *= 0.8) {
    Eigen::Matrix2d H =
        Eigen::Vector2d(1e-6, 0.05).asDiagonal();  // upright, unless points say else
    Eigen::Matrix2d b = Eigen::Matrix2d::Zero();
    for (const Vector3d& p : points) {
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

/// Points within reach of the surface, the spread of their residuals, and their sectors.
struct Near {
  std::vector<const Vector3d*> points;
  std::array<double, sectors> count{};
  double sigma = 0;
};

Near near_surface(const Points& points, const Stem& stem, double reach) {
  Near out;
  std::vector<double> size;
  for (const Vector3d& p : points) {
    if (p.z() < lowest || p.z() > highest) continue;
    const double r = std::abs(stem.residual(p));
    if (r > reach) continue;
    out.points.push_back(&p);
    out.count[sector_of(stem.off_axis(p))] += 1;
    size.push_back(r);
  }
  if (size.empty()) return out;
  const auto middle = size.begin() + std::ptrdiff_t(size.size() / 2);
  std::nth_element(size.begin(), middle, size.end());
  out.sigma = std::clamp(1.4826 * *middle, least_sigma, largest_sigma);
  return out;
}

/// One Gauss-Newton step with Tukey's weights.
void refine(const Near& near, double cutoff, Stem& stem) {
  Matrix6d H = Matrix6d::Zero();
  Vector6d g = Vector6d::Zero();
  const double fair = double(near.points.size()) / double(sectors);
  for (const Vector3d* p : near.points) {
    const Vector3d off = stem.off_axis(*p);
    const double length = std::max(off.norm(), 1e-6), t = p->z() - breast_height;
    const double e = stem.residual(*p), u = e / cutoff;
    if (std::abs(u) >= 1) continue;
    const double crowd = near.count[sector_of(off)];
    const double weight =
        std::pow(1 - u * u, 2) * std::sqrt(std::min(1.0, fair / crowd)) / (near.sigma * near.sigma);
    const Vector2d n = off.head<2>() / length;
    Vector6d J;
    J << -n, -t * n, -1, -t;
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

}  // namespace

Vector3d Stem::off_axis(const Vector3d& p) const {
  const Vector3d d = p - Vector3d(center.x(), center.y(), breast_height), a = axis();
  return d - d.dot(a) * a;
}

double Stem::residual(const Vector3d& p) const {
  return off_axis(p).norm() - radius - taper * (p.z() - breast_height);
}

bool polish(const Points& points, const FitLimits& limits, int iterations, Stem& stem) {
  double reach = 0.08;
  for (int i = 0; i < iterations; ++i) {
    const Near near = near_surface(points, stem, reach);
    if (int(near.points.size()) < limits.min_points) return false;
    reach = std::clamp(3 * near.sigma, 0.03, 0.06);
    refine(near, reach, stem);
    if (!(stem.radius > 0.01 && stem.radius < limits.max_dbh)) return false;
  }
  const Near near = near_surface(points, stem, reach);
  if (int(near.points.size()) < limits.min_points) return false;
  stem.points = int(near.points.size());
  stem.sigma = near.sigma;
  stem.coverage = 0;
  for (const double count : near.count) stem.coverage += (count > 0) / double(sectors);
  const double bias = 2 * near.sigma * near.sigma;
  stem.radius = 0.5 * (stem.radius + std::sqrt(std::max(0.0, stem.radius * stem.radius - bias)));
  const bool sized = 2 * stem.radius >= limits.min_dbh && 2 * stem.radius <= limits.max_dbh;
  return sized && stem.lean.norm() <= std::tan(limits.max_lean);
}

std::optional<Stem> fit_stem(const Points& points, const FitLimits& limits, std::uint64_t seed) {
  Stem stem;
  stem.taper = usual_taper;
  stem.lean = lean_of(points, limits.max_lean);
  std::vector<Vector2d> across;
  for (const double half : {0.7, 1.2}) {
    across.clear();
    for (const Vector3d& p : points)
      if (std::abs(p.z() - breast_height) < half && p.z() > lowest)
        across.push_back(p.head<2>() - (p.z() - breast_height) * stem.lean);
    if (across.size() >= 3u * std::size_t(limits.min_points)) break;
  }
  const auto circle = sample_circle(across, limits.min_dbh / 2, limits.max_dbh / 2, seed);
  if (!circle) return std::nullopt;
  stem.center = circle->center;
  stem.radius = circle->radius;
  if (!polish(points, limits, 10, stem)) return std::nullopt;
  return stem;
}

}  // namespace stem_extraction
