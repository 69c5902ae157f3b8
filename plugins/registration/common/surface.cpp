// SPDX-License-Identifier: BSD-3-Clause
#include "common/surface.hpp"

#include <pcl/common/centroid.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace cambium::registration {
namespace {

struct CellOfPoint {
  std::array<std::int32_t, 3> cell;
  std::uint32_t point;
  auto operator<=>(const CellOfPoint&) const = default;
};

// No lidar sees farther; the bound keeps cell numbers inside 32 bits for any voxel above 1 mm.
constexpr float farthest = 1e6F;

std::vector<CellOfPoint> cells_of(const Cloud& cloud, double voxel_size) {
  std::vector<CellOfPoint> cells;
  cells.reserve(cloud.size());
  const auto points = cloud.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    // Written so that NaN fails.
    if (!(points.col(i).cwiseAbs().maxCoeff() < farthest) || !points.col(i).allFinite()) continue;
    CellOfPoint c{{}, std::uint32_t(i)};
    for (int k = 0; k < 3; ++k)
      c.cell[std::size_t(k)] = std::int32_t(std::floor(double(points(k, i)) / voxel_size));
    cells.push_back(c);
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

// The smallest principal axis of the points at `indices`, turned towards the origin (the sensor).
Eigen::Vector3f normal_of(const Points& points, const pcl::Indices& indices, const Point& at) {
  Eigen::Matrix3d covariance;
  Eigen::Vector4d mean;
  pcl::computeMeanAndCovarianceMatrix(points, indices, covariance, mean);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes;
  axes.computeDirect(covariance);
  const Eigen::Vector3f n = axes.eigenvectors().col(0).cast<float>();
  return n.dot(at.getVector3fMap()) > 0 ? Eigen::Vector3f(-n) : n;
}

}  // namespace

std::size_t Surface::bytes() const {
  constexpr std::size_t tree_node = 64;  // FLANN: leaves of 15 points, a copy of the coordinates
  return size() * (sizeof(Point) + 3 * sizeof(float) + sizeof(int) + tree_node / 8);
}

Points::Ptr thin(const Cloud& cloud, double voxel_size) {
  const std::vector<CellOfPoint> cells = cells_of(cloud, voxel_size);
  const auto from = cloud.points();
  auto out = std::make_shared<Points>();
  for (std::size_t i = 0; i < cells.size();) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    const std::size_t first = i;
    for (; i < cells.size() && cells[i].cell == cells[first].cell; ++i)
      sum += from.col(Eigen::Index(cells[i].point)).cast<double>();
    Point p;
    p.getVector3fMap() = (sum / double(i - first)).cast<float>();
    out->push_back(p);
  }
  return out;
}

Points::Ptr sample(const Points& points, std::size_t limit) {
  const std::size_t step = (points.size() + limit - 1) / limit;
  auto out = std::make_shared<Points>();
  for (std::size_t i = 0; i < points.size(); i += step) out->push_back(points[i]);
  return out;
}

Surface make_surface(Points::Ptr points, int neighbours) {
  if (points->empty()) return {points, nullptr};
  auto tree = std::make_shared<Tree>();
  tree->setInputCloud(points);
  pcl::Indices near;
  std::vector<float> squared;
  for (Point& p : *points) {
    tree->nearestKSearch(p, neighbours, near, squared);
    p.getNormalVector3fMap() = normal_of(*points, near, p);
  }
  return {points, tree};
}

}  // namespace cambium::registration
