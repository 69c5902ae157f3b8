// SPDX-License-Identifier: BSD-3-Clause
#include "common/voxels.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::filter {
namespace {

Eigen::Vector3f row(const std::vector<float>& table, std::size_t i) {
  return {table[3 * i], table[3 * i + 1], table[3 * i + 2]};
}

void append(std::vector<float>& table, const Vec3& value) {
  for (const double v : value) table.push_back(float(v));
}

}  // namespace

std::optional<std::uint64_t> voxel_of(const Eigen::Vector3f& point, double size) {
  constexpr double half = 1 << 20;
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double cell = std::floor(double(point[axis]) / size) + half;
    if (!(cell >= 0.0 && cell < 2.0 * half)) return std::nullopt;  // false for NaN, too
    key = key << 21 | std::uint64_t(cell);
  }
  return key;
}

std::vector<PointInVoxel> sorted_by_voxel(const Cloud& cloud, double size) {
  std::vector<PointInVoxel> out;
  out.reserve(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (const auto voxel = voxel_of(cloud.points().col(Eigen::Index(i)), size))
      out.push_back({*voxel, std::uint32_t(i)});
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<VoxelMeans::Sum> VoxelMeans::sums_of(const Cloud& cloud,
                                                 const std::vector<PointInVoxel>& points) const {
  std::vector<Sum> out;
  for (const auto& [voxel, i] : points) {
    Sum one{voxel, 1, row(cloud.xyz, i).cast<double>()};
    if (normals_) {
      one.first_normal = row(cloud.normals, i);
      one.normal = one.first_normal.cast<double>();
    }
    if (intensity_) one.intensity = cloud.intensity[i];
    if (label_) one.label = cloud.label[i];
    if (!out.empty() && out.back().voxel == voxel)
      merge(out.back(), one);
    else
      out.push_back(one);
  }
  return out;
}

void VoxelMeans::merge(Sum& into, const Sum& other) {
  into.count += other.count;
  into.position += other.position;
  into.normal += other.normal;
  into.intensity += other.intensity;
  if (into.label != other.label) into.label = 0;
}

std::size_t VoxelMeans::add(const Cloud& cloud) {
  if (cloud.empty()) return 0;
  normals_ = normals_ && !cloud.normals.empty();
  intensity_ = intensity_ && !cloud.intensity.empty();
  label_ = label_ && !cloud.label.empty();
  const auto points = sorted_by_voxel(cloud, size_);
  const std::vector<Sum> added = sums_of(cloud, points);
  std::vector<Sum> all;
  all.reserve(sums_.size() + added.size());
  auto old = sums_.begin();
  for (const Sum& sum : added) {
    for (; old != sums_.end() && old->voxel < sum.voxel; ++old) all.push_back(*old);
    if (old != sums_.end() && old->voxel == sum.voxel) {
      all.push_back(*old++);
      merge(all.back(), sum);
    } else {
      all.push_back(sum);
    }
  }
  all.insert(all.end(), old, sums_.end());
  sums_ = std::move(all);
  return cloud.size() - points.size();
}

Cloud VoxelMeans::means(int min_points) const {
  Cloud out;
  for (const Sum& s : sums_) {
    if (s.count < min_points) continue;
    append(out.xyz, s.position / s.count);
    // Opposite normals leave no direction; any one of them is still a normal of the surface.
    const bool none = s.normal.norm() < 1e-6 * s.count;
    const Vec3 normal = none ? Vec3(s.first_normal.cast<double>()) : s.normal;
    if (normals_) append(out.normals, normal.normalized());
    if (intensity_) out.intensity.push_back(float(s.intensity / s.count));
    if (label_) out.label.push_back(s.label);
  }
  return out;
}

}  // namespace cambium::filter
