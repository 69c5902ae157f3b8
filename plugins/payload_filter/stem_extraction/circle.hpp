// SPDX-License-Identifier: BSD-3-Clause
// A circle among points that are not all on it.
#pragma once
#include <Eigen/Core>
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

/// The circle with radius within the limits that most points lie on, of many through three of
/// them. A point deep inside takes away what one on the circle gives: rays do not enter stems.
std::optional<Circle> sample_circle(const std::vector<Eigen::Vector2d>& points, double min_radius,
                                    double max_radius, std::uint64_t seed);

}  // namespace stem_extraction
