// SPDX-License-Identifier: BSD-3-Clause
#include "circle.hpp"

#include <array>
#include <limits>

namespace stem_extraction {
namespace {

using Eigen::Vector2d;

constexpr double tolerance = 0.025;  // of a point on the circle: noise and drift of a submap [m]
constexpr int samples = 200;
constexpr std::size_t most_points = 300;

/// splitmix64 (Steele et al. 2014): the same numbers everywhere.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::size_t below(std::size_t n) {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15u);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return std::size_t((z ^ (z >> 31)) % n);
  }

 private:
  std::uint64_t state_;
};

// Points on the circle, where a crowd in one direction counts less than the same number spread
// around: a large circle through a thin stem holds many points, too, but on one side only.
double support(const std::vector<Vector2d>& points, const Circle& circle) {
  std::array<double, sectors> on{};
  double inside = 0;
  for (const Vector2d& p : points) {
    const Vector2d d = p - circle.center;
    const double u = (d.norm() - circle.radius) / tolerance;
    if (std::abs(u) < 1)
      on[sector(d.x(), d.y())] += 1 - u * u;
    else if (u < -2)
      inside += 1;
  }
  double sum = -inside / std::sqrt(double(points.size()));
  for (const double n : on) sum += std::sqrt(n);
  return sum;
}

}  // namespace

std::optional<Circle> circle_through(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const Vector2d u = b - a, v = c - a;
  const double cross = 2 * (u.x() * v.y() - u.y() * v.x());
  if (std::abs(cross) < 1e-9) return std::nullopt;
  const double uu = u.squaredNorm(), vv = v.squaredNorm();
  const Vector2d center((v.y() * uu - u.y() * vv) / cross, (u.x() * vv - v.x() * uu) / cross);
  return Circle{a + center, center.norm()};
}

std::optional<Circle> sample_circle(const std::vector<Vector2d>& all, double min_radius,
                                    double max_radius, std::uint64_t seed) {
  std::vector<Vector2d> points;
  const std::size_t step = all.size() / most_points + 1;
  for (std::size_t i = 0; i < all.size(); i += step) points.push_back(all[i]);
  if (points.size() < 3) return std::nullopt;
  Random random(seed);
  std::optional<Circle> best;
  double most = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < samples; ++i) {
    const auto one = [&] { return points[random.below(points.size())]; };
    const Vector2d a = one(), b = one(), c = one();
    const auto circle = circle_through(a, b, c);
    if (!circle || circle->radius < min_radius || circle->radius > max_radius) continue;
    const double found = support(points, *circle);
    if (found <= most) continue;
    most = found;
    best = circle;
  }
  return best;
}

}  // namespace stem_extraction
