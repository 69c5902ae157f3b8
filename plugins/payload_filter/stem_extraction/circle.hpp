// SPDX-License-Identifier: BSD-3-Clause
// A circle among points that are not all on it.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace stem_extraction {

struct Circle {
  Eigen::Vector2d center{0, 0};
  double radius = 0;
};

/// Through three points; nothing when they lie on a line.
std::optional<Circle> circle_through(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                                     const Eigen::Vector2d& c);

/// One of sixteen sectors around the origin, in no order.
inline std::size_t sector(double x, double y) {
  const double a = std::abs(x), b = std::abs(y);
  constexpr double tan_22_5 = 0.41421356;
  return std::size_t(x > 0) | std::size_t(y > 0) << 1 | std::size_t(a > b) << 2 |
         std::size_t(std::min(a, b) > tan_22_5 * std::max(a, b)) << 3;
}
constexpr std::size_t sectors = 16;

/// The circle with a radius within the limits that most points lie on, of many through three of
/// them (MSAC; Torr & Zisserman, CVIU 2000). A crowd on one side counts for less than the same
/// number spread around, and points deep inside speak against a circle: rays do not enter stems.
std::optional<Circle> sample_circle(const std::vector<Eigen::Vector2d>& points, double min_radius,
                                    double max_radius, std::uint64_t seed);

}  // namespace stem_extraction
