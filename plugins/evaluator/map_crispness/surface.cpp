// SPDX-License-Identifier: BSD-3-Clause
#include "surface.hpp"

#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace map_crispness {
namespace {

// A plane is fitted through so many points. Fewer lie in one ring of a scan, which is a line.
constexpr int neighbours = 15;
// Flat: across it, the points spread by less than a fifth of what they spread along it; and they
// are no line.
constexpr double max_thickness = 0.2 * 0.2, min_width = 0.1 * 0.1;

pcl::PointXYZ pcl_point(const Eigen::Vector3d& p) {
  return {float(p.x()), float(p.y()), float(p.z())};
}

}  // namespace

cambium::Cloud thinned(const cambium::Cloud& cloud, double voxel_size) {
  struct Entry {
    std::array<double, 3> voxel;
    std::size_t point;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  const auto points = cloud.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    if (!points.col(i).allFinite()) continue;
    const Eigen::Vector3d v = (points.col(i).cast<double>() / voxel_size).array().floor();
    entries.push_back({{v.x(), v.y(), v.z()}, std::size_t(i)});
  }
  std::sort(entries.begin(), entries.end());
  const auto end = std::unique(entries.begin(), entries.end(),
                               [](const Entry& a, const Entry& b) { return a.voxel == b.voxel; });
  std::vector<std::size_t> kept;
  for (auto it = entries.begin(); it != end; ++it) kept.push_back(it->point);
  return cambium::select(cloud, kept);
}

struct Surface::Tree {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points{new pcl::PointCloud<pcl::PointXYZ>};
  pcl::KdTreeFLANN<pcl::PointXYZ> search;
  pcl::Indices indices;
  std::vector<float> squared_distances;
};

Surface::Surface(const cambium::Cloud& target) : tree_(std::make_unique<Tree>()) {
  const auto points = target.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      tree_->points->push_back(pcl_point(points.col(i).cast<double>()));
  planes_.resize(tree_->points->size());
  if (!planes_.empty()) tree_->search.setInputCloud(tree_->points);
}

Surface::~Surface() = default;

const std::optional<Surface::Plane>& Surface::plane_at(int index) {
  auto& known = planes_[std::size_t(index)];
  if (known) return *known;
  known.emplace();
  Tree& t = *tree_;
  const int found = t.search.nearestKSearch((*t.points)[std::size_t(index)], neighbours, t.indices,
                                            t.squared_distances);
  Eigen::Matrix3Xd near(3, found);
  for (int k = 0; k < found; ++k)
    near.col(k) =
        (*t.points)[std::size_t(t.indices[std::size_t(k)])].getVector3fMap().cast<double>();
  const Eigen::Vector3d center = near.rowwise().mean();
  const Eigen::Matrix3Xd spread = near.colwise() - center;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread * spread.transpose());
  const Eigen::Vector3d& lambda = solver.eigenvalues();  // ascending
  if (found == neighbours && lambda[0] < max_thickness * lambda[1] &&
      lambda[1] > min_width * lambda[2])
    known->emplace(Plane{center, solver.eigenvectors().col(0)});
  return *known;
}

std::vector<double> Surface::distances(const cambium::Cloud& source,
                                       const cambium::SE3& T_target_source, double radius) {
  std::vector<double> out;
  if (planes_.empty()) return out;
  Tree& t = *tree_;
  const Eigen::Matrix3d R = T_target_source.rotation();
  const auto points = source.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3d p = R * points.col(i).cast<double>() + T_target_source.t;
    if (!p.allFinite()) continue;
    t.search.nearestKSearch(pcl_point(p), 1, t.indices, t.squared_distances);
    if (!(t.squared_distances[0] <= radius * radius)) continue;
    if (const auto& plane = plane_at(t.indices[0]))
      out.push_back(std::abs(plane->normal.dot(p - plane->center)));
  }
  return out;
}

}  // namespace map_crispness
