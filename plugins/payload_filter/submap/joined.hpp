// SPDX-License-Identifier: BSD-3-Clause
// Clouds put together, thinned on the way or not.
#pragma once
#include "common/voxels.hpp"

namespace submap {

class Joined {
 public:
  /// Edge of the voxels that are thinned to a mean [m]; 0 keeps every point.
  explicit Joined(double voxel) : voxel_(voxel), means_(voxel) {}

  void add(const cambium::Cloud& cloud);
  /// Normals, intensities and labels only when every cloud with a point had them.
  cambium::Cloud take();

 private:
  double voxel_;
  cambium::filter::VoxelMeans means_;
  bool normals_ = true, intensity_ = true, label_ = true;
  cambium::Cloud all_;
};

inline void Joined::add(const cambium::Cloud& cloud) {
  if (cloud.empty()) return;
  if (voxel_ > 0) {
    means_.add(cloud);
    return;
  }
  const auto append = [](auto& to, const auto& from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  append(all_.xyz, cloud.xyz);
  normals_ = normals_ && !cloud.normals.empty();
  intensity_ = intensity_ && !cloud.intensity.empty();
  if (normals_) append(all_.normals, cloud.normals);
  label_ = label_ && !cloud.label.empty();
  if (intensity_) append(all_.intensity, cloud.intensity);
  if (label_) append(all_.label, cloud.label);
}

inline cambium::Cloud Joined::take() {
  if (voxel_ > 0) return means_.means();
  if (!normals_) all_.normals.clear();
  if (!intensity_) all_.intensity.clear();
  if (!label_) all_.label.clear();
  return std::move(all_);
}

}  // namespace submap
