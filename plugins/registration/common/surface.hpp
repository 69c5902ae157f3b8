// SPDX-License-Identifier: BSD-3-Clause
// A cloud made ready for registration: thinned, with a normal per point and a search structure.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "common/block_index.hpp"

namespace cambium::registration {

/// A point of a surface, in the base frame. The normal has unit length and is turned towards the
/// origin (the sensor); it is zero where the points around do not tell a plane.
struct Patch {
  Eigen::Vector3f at = Eigen::Vector3f::Zero(), normal = Eigen::Vector3f::Zero();
};
using Patches = std::vector<Patch>;

struct Surface {
  Patches patches;
  BlockIndex index;  ///< over `patches`
  std::size_t size() const { return patches.size(); }
  std::size_t bytes() const { return size() * sizeof(Patch) + index.bytes(); }
};

/// Every k-th patch, k the smallest number that leaves at most `limit`: they are ordered by block,
/// so this thins evenly.
Patches sample(const Patches& patches, std::size_t limit);

/// The thinned points with normals: each that of the plane through the points in the voxels
/// around, 3 x 3 x 3 of them or up to 9 x 9 x 9 until they hold at least `neighbours` points.
Surface make_surface(const Thinned& cloud, int neighbours);

}  // namespace cambium::registration
