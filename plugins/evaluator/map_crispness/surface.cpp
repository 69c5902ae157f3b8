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
// are no line. Of variances, so squared.
constexpr double max_thickness = 0.2 * 0.2, min_width = 0.1 * 0.1;
// A stem is narrower than 15 points of a scan reach: it is a line along the vertical, as thin as
// the bark and the range noise make its face [m^2].
constexpr double max_bark = 0.05 * 0.05;
constexpr double min_ground_cosine = 0.82;   // 35 degrees: slopes, and stones on them
constexpr double max_upright_cosine = 0.35;  // 20 degrees from the vertical
constexpr double min_stem_cosine = 0.9;      // 25 degrees: stems lean

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

  Eigen::Vector3d point(int i) const {
    return (*points)[std::size_t(i)].getVector3fMap().cast<double>();
  }
};

Surface::Surface(const cambium::Cloud& scan, const Vec3& up)
    : up_(up), tree_(std::make_unique<Tree>()) {
  const auto points = scan.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite())
      tree_->points->push_back(pcl_point(points.col(i).cast<double>()));
  planes_.resize(tree_->points->size());
  if (!planes_.empty()) tree_->search.setInputCloud(tree_->points);
}

Surface::~Surface() = default;

std::optional<Surface::Plane> Surface::fit(int index) {
  Tree& t = *tree_;
  const int found = t.search.nearestKSearch((*t.points)[std::size_t(index)], neighbours, t.indices,
                                            t.squared_distances);
  if (found < neighbours) return std::nullopt;
  Eigen::Matrix3Xd near(3, found);
  for (int k = 0; k < found; ++k) near.col(k) = t.point(t.indices[std::size_t(k)]);
  const Eigen::Vector3d center = near.rowwise().mean();
  near.colwise() -= center;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(near * near.transpose() / found);
  const Eigen::Vector3d& variance = solver.eigenvalues();  // ascending
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  const double tilt = std::abs(normal.dot(up_));
  const bool flat =
      variance[0] < max_thickness * variance[1] && variance[1] > min_width * variance[2];
  const bool stem = variance[0] < max_bark && variance[1] < max_thickness * variance[2] &&
                    std::abs(solver.eigenvectors().col(2).dot(up_)) > min_stem_cosine;
  if (flat && tilt > min_ground_cosine) return Plane{center, normal, Kind::ground};
  if ((flat || stem) && tilt < max_upright_cosine) return Plane{center, normal, Kind::upright};
  return std::nullopt;
}

const std::optional<Surface::Plane>& Surface::plane_at(int index) {
  auto& known = planes_[std::size_t(index)];
  if (!known) known.emplace(fit(index));
  return *known;
}

std::vector<Contact> Surface::contacts(const cambium::Cloud& source,
                                       const cambium::SE3& T_this_source, double radius) {
  std::vector<Contact> out;
  if (planes_.empty()) return out;
  Tree& t = *tree_;
  const Eigen::Matrix3d R = T_this_source.rotation();
  const auto points = source.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Vec3 p_source = points.col(i).cast<double>();
    const Vec3 p = R * p_source + T_this_source.t;
    if (!p.allFinite()) continue;
    t.search.nearestKSearch(pcl_point(p), 1, t.indices, t.squared_distances);
    if (!(t.squared_distances[0] <= radius * radius)) continue;
    if (const auto& plane = plane_at(t.indices[0]))
      out.push_back({p_source, p, std::abs(plane->normal.dot(p - plane->center)), plane->kind});
  }
  return out;
}

std::vector<Vec3> Surface::around(const Vec3& p, double radius) {
  std::vector<Vec3> out;
  if (planes_.empty()) return out;
  Tree& t = *tree_;
  t.search.radiusSearch(pcl_point(p), radius, t.indices, t.squared_distances);
  for (const int i : t.indices) out.push_back(t.point(i));
  return out;
}

}  // namespace map_crispness
