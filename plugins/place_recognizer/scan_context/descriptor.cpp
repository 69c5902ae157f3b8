// SPDX-License-Identifier: BSD-3-Clause
#include "descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace scan_context {
namespace {

// Bins start at 0 = empty, so taking the maximum also discards what is lower than -height_offset.
void keep_highest(const cambium::Cloud& cloud, const Eigen::Matrix3f& R_level_base,
                  const Eigen::Vector2f& viewpoint, const Grid& grid, std::span<float> columns) {
  const auto points = cloud.points();
  const float rings_per_metre = float(grid.rings / grid.max_range);
  const float sectors_per_radian = float(grid.sectors / (2.0 * std::numbers::pi));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    Eigen::Vector3f p = R_level_base * points.col(i);
    p.head<2>() -= viewpoint;
    if (!p.allFinite()) continue;
    const float ring = std::hypot(p.x(), p.y()) * rings_per_metre;
    if (ring >= float(grid.rings)) continue;
    float azimuth = std::atan2(p.y(), p.x());
    if (azimuth < 0) azimuth += 2.0f * std::numbers::pi_v<float>;
    const int sector = std::min(int(azimuth * sectors_per_radian), grid.sectors - 1);
    float& bin = columns[std::size_t(sector * grid.rings + int(ring))];
    bin = std::max(bin, p.z() + float(grid.height_offset));
  }
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

void describe(const cambium::Cloud& cloud, const cambium::Quat& q_level_base, const Grid& grid,
              const Eigen::Vector2f& viewpoint, std::span<float> columns) {
  std::fill(columns.begin(), columns.end(), 0.0f);
  keep_highest(cloud, q_level_base.toRotationMatrix().cast<float>(), viewpoint, grid, columns);
  Eigen::Map<Eigen::MatrixXf> by_sector(columns.data(), grid.rings, grid.sectors);
  for (auto column : by_sector.colwise()) column.stableNormalize();
}

}  // namespace scan_context
