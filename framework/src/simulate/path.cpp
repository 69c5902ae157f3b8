// SPDX-License-Identifier: BSD-3-Clause
// The shapes of paths.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/angles.hpp"
#include "simulate/trajectory.hpp"

namespace cambium::simulate {
namespace {

using Vec2 = Eigen::Vector2d;

std::vector<Vec2> ellipse(double length, double width) {
  constexpr int corners = 180;
  std::vector<Vec2> out;
  for (int i = 0; i <= corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners;
    out.emplace_back(0.5 * length * std::sin(a), -0.5 * width * std::cos(a));
  }
  return out;
}

std::vector<Vec2> lanes(double length, double width, int count) {
  std::vector<Vec2> out;
  for (int i = 0; i < count; ++i) {
    const double y = count > 1 ? width * (double(i) / (count - 1) - 0.5) : 0;
    const double x = (i % 2 == 0 ? -0.5 : 0.5) * length;
    out.emplace_back(x, y);
    out.emplace_back(-x, y);
  }
  return out;
}

std::vector<Vec2> shape(const PathSpec& p) {
  if (p.kind == "loop") return ellipse(p.size[0], p.size[1]);
  if (p.kind == "lawn_mower") return lanes(p.size[0], p.size[1], p.lanes);
  if (p.kind == "line") return {{-0.5 * p.size[0], 0}, {0.5 * p.size[0], 0}};
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < p.waypoints.size(); i += 2)
    out.emplace_back(p.waypoints[i], p.waypoints[i + 1]);
  return out;
}

// Every corner moves to the left of the direction in which the path passes it.
std::vector<Vec2> moved_left(const std::vector<Vec2>& corners, double offset) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2 d = corners[std::min(i + 1, corners.size() - 1)] - corners[i > 0 ? i - 1 : 0];
    const double norm = std::max(d.norm(), 1e-9);
    out.push_back(corners[i] + offset / norm * Vec2(-d.y(), d.x()));
  }
  return out;
}

}  // namespace

std::vector<Vec2> path_corners(const PathSpec& p) {
  std::vector<Vec2> corners = moved_left(shape(p), p.offset);
  const Eigen::Rotation2Dd turn(radians(p.heading));
  for (Vec2& c : corners) c = turn * c + Vec2(p.center[0], p.center[1]);
  if (p.reversed) std::reverse(corners.begin(), corners.end());
  return corners;
}

}  // namespace cambium::simulate
