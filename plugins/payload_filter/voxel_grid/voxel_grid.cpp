// SPDX-License-Identifier: BSD-3-Clause
// Thins a cloud: one point per voxel, the mean of the points in it.
#include <algorithm>
#include <cmath>
#include <optional>

#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

struct Entry {
  std::uint64_t voxel;  ///< x, y and z of the voxel, 21 bits each: the order of the result
  std::size_t point;
  bool operator<(const Entry& o) const {
    return voxel != o.voxel ? voxel < o.voxel : point < o.point;
  }
};

/// The voxel of a point on the grid through the origin; nothing for a point that is not finite or
/// more than 2^20 voxels away from the origin.
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

/// The sum of rows of a table with `width` numbers a point. Sums of floats in double are exact as
/// long as their exponents are alike, so the mean does not depend on the order of the points.
Eigen::Vector3d sum(const std::vector<float>& table, std::size_t width,
                    std::span<const Entry> entries) {
  Eigen::Vector3d total = Eigen::Vector3d::Zero();
  for (const Entry& e : entries)
    for (std::size_t i = 0; i < width; ++i) total[Eigen::Index(i)] += table[e.point * width + i];
  return total;
}

void append(std::vector<float>& table, const Eigen::Vector3d& value) {
  for (const double v : value) table.push_back(float(v));
}

/// Appends the mean of the points at `entries`: position, direction of the normal, intensity.
void append_mean(const Cloud& cloud, std::span<const Entry> entries, Cloud& out) {
  const double n = double(entries.size());
  append(out.xyz, sum(cloud.xyz, 3, entries) / n);
  if (!cloud.normals.empty()) {
    Eigen::Vector3d normal = sum(cloud.normals, 3, entries);
    // Opposite normals leave no direction; any one of them is still a normal of the surface.
    if (normal.norm() < 1e-6 * n) normal = sum(cloud.normals, 3, entries.first(1));
    append(out.normals, normal.normalized());
  }
  if (!cloud.intensity.empty())
    out.intensity.push_back(float(sum(cloud.intensity, 1, entries).x() / n));
}

class VoxelGrid final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("size", size_, "Edge of a voxel", above(0.0, "m"));
    v("min_points", min_points_, "Voxels with fewer points are dropped as noise",
      between(1, 1000000));
  }

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    const std::vector<Entry> entries = sorted_by_voxel(*payload.cloud);
    const std::size_t dropped = payload.cloud->size() - entries.size();
    if (dropped > 0)
      context.warn(mission.mission().name + " node " +
                   std::to_string(mission.mission().nodes[node].id) + ": voxel_grid dropped " +
                   std::to_string(dropped) + " of " + std::to_string(payload.cloud->size()) +
                   " points that are not finite or a million voxels away");
    auto thinned = std::make_shared<Cloud>();
    for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
      while (end < entries.size() && entries[end].voxel == entries[begin].voxel) ++end;
      if (end - begin >= std::size_t(min_points_))
        append_mean(*payload.cloud, std::span(entries).subspan(begin, end - begin), *thinned);
    }
    payload.cloud = std::move(thinned);
    return payload;
  }

 private:
  std::vector<Entry> sorted_by_voxel(const Cloud& cloud) const {
    std::vector<Entry> entries;
    entries.reserve(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i)
      if (const auto voxel = voxel_of(cloud.points().col(Eigen::Index(i)), size_))
        entries.push_back({*voxel, i});
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  double size_ = 0.25;
  int min_points_ = 1;
};

}  // namespace

CAMBIUM_PLUGIN("voxel_grid", "0.1.0") {
  registry.add<VoxelGrid>("voxel_grid", "Thins a cloud to the mean of the points in each voxel");
}
