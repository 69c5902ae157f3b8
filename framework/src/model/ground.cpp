// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/ground.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cambium {
namespace {

/// The mean over the lowest layer of the points of a cell.
Vec3 lowest(const std::vector<Vec3>& points, double thickness) {
  double z = points.front().z();
  for (const Vec3& p : points) z = std::min(z, p.z());
  Vec3 sum = Vec3::Zero();
  std::size_t count = 0;
  for (const Vec3& p : points) {
    if (p.z() > z + thickness) continue;
    sum += p;
    ++count;
  }
  return sum / double(count);
}

/// The ground that one scan saw, in the map frame.
std::map<Cell, Vec3> seen_by(const Cloud& cloud, const SE3& T_map_node,
                             const GroundOptions& options) {
  std::map<Cell, std::vector<Vec3>> cells;
  const Mat3 R = T_map_node.rotation();
  const auto points = cloud.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 from_node = R * points.col(i).cast<double>();
    if (!(from_node.head<2>().norm() <= options.max_range)) continue;  // true for NaN
    const Vec3 p = from_node + T_map_node.t;
    if (!p.allFinite()) continue;
    cells[{int(std::floor(p.x() / options.cell_size)), int(std::floor(p.y() / options.cell_size))}]
        .push_back(p);
  }
  std::map<Cell, Vec3> out;
  for (const auto& [cell, inside] : cells)
    if (int(inside.size()) >= options.min_points) out[cell] = lowest(inside, options.thickness);
  return out;
}

Vec3 median_height(std::vector<Vec3> points) {
  const auto middle = points.begin() + std::ptrdiff_t((points.size() - 1) / 2);
  std::stable_sort(points.begin(), points.end(),
                   [](const Vec3& a, const Vec3& b) { return a.z() < b.z(); });
  return *middle;
}

}  // namespace

Ground::Ground(const Atlas& atlas, const std::vector<std::uint32_t>& missions,
               const GroundOptions& options, const Context& context)
    : cell_size_(options.cell_size) {
  std::map<Cell, std::vector<Vec3>> seen;
  for (const std::uint32_t m : missions) {
    const MissionView mission{atlas, m};
    std::vector<std::map<Cell, Vec3>> scans(mission.size());
    context.parallel_for(mission.size(), [&](std::size_t n) {
      context.check_cancelled();
      if (const auto cloud = mission.payload(n).cloud)
        scans[n] = seen_by(*cloud, mission.T_map_node(n), options);
    });
    for (const auto& scan : scans)
      for (const auto& [cell, p] : scan) seen[cell].push_back(p);
  }
  for (const auto& [cell, points] : seen) cells_[cell] = median_height(points);
}

std::optional<double> Ground::height(const Cell& c, double x, double y) const {
  Mat3 A = Mat3::Zero();
  Vec3 b = Vec3::Zero();
  int known = 0;
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j) {
      const auto it = cells_.find({c[0] + i, c[1] + j});
      if (it == cells_.end()) continue;
      const Vec3 row((it->second.x() - x) / cell_size_, (it->second.y() - y) / cell_size_, 1);
      A += row * row.transpose();
      b += row * it->second.z();
      ++known;
    }
  const Eigen::FullPivLU<Eigen::Matrix3d> solver(A);
  if (known < 4 || solver.rcond() < 1e-3) return std::nullopt;
  return solver.solve(Eigen::Vector3d(b)).z();
}

}  // namespace cambium
