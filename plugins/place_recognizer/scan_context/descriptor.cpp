// SPDX-License-Identifier: BSD-3-Clause
#include "descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scan_context {
namespace {

/// The azimuth of (x, y) in turns, 0..1. With several viewpoints this is where the time goes, so
/// the arctangent is a polynomial (Abramowitz, Stegun 1964, 4.4.49): 1e-5 rad, 1 mm at 80 m.
float turns(float x, float y) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float larger = std::max(ax, ay);
  if (larger == 0.0f) return 0.0f;
  const float t = std::min(ax, ay) / larger, t2 = t * t;
  float angle = t * (0.9998660f +
                     t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  constexpr float pi = std::numbers::pi_v<float>;
  if (ay > ax) angle = 0.5f * pi - angle;
  if (x < 0) angle = pi - angle;
  if (y < 0) angle = 2.0f * pi - angle;
  return angle / (2.0f * pi);
}

}  // namespace

cambium::Quat level_rotation(const cambium::SE3& T_mission_node) {
  const Eigen::Vector3d up_base = T_mission_node.q.conjugate() * cambium::Vec3::UnitZ();
  return cambium::Quat::FromTwoVectors(up_base, Eigen::Vector3d::UnitZ());
}

std::vector<Eigen::Vector2f> viewpoints(double radius, double step) {
  std::vector<Eigen::Vector2f> out;
  const int n = int(radius / step);
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      if (std::hypot(x, y) * step <= radius) out.emplace_back(float(x * step), float(y * step));
  std::stable_sort(out.begin(), out.end(), [](const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
    return a.squaredNorm() < b.squaredNorm();
  });
  return out;
}

cambium::Cloud::Matrix3X levelled(const cambium::Cloud& cloud, const cambium::Quat& q_level_base) {
  const Eigen::Matrix3f R_level_base = q_level_base.toRotationMatrix().cast<float>();
  const auto points = cloud.points();
  cambium::Cloud::Matrix3X out(3, points.cols());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) out.col(n++).noalias() = R_level_base * points.col(i);
  out.conservativeResize(Eigen::NoChange, n);
  return out;
}

// Bins start at 0 = empty, so taking the maximum also discards what is lower than -height_offset.
void describe(const cambium::Cloud::Matrix3X& points, const Grid& grid,
              const Eigen::Vector2f& viewpoint, std::span<float> columns) {
  std::fill(columns.begin(), columns.end(), 0.0f);
  const float rings_per_metre = float(grid.rings / grid.max_range);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const float x = points(0, i) - viewpoint.x(), y = points(1, i) - viewpoint.y();
    const float ring = std::sqrt(x * x + y * y) * rings_per_metre;
    if (!(ring < float(grid.rings))) continue;
    const int sector = std::min(int(turns(x, y) * float(grid.sectors)), grid.sectors - 1);
    float& bin = columns[std::size_t(sector * grid.rings + int(ring))];
    bin = std::max(bin, points(2, i) + float(grid.height_offset));
  }
  Eigen::Map<Eigen::MatrixXf> by_sector(columns.data(), grid.rings, grid.sectors);
  for (auto column : by_sector.colwise()) column.stableNormalize();
}

}  // namespace scan_context
