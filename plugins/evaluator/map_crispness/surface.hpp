// SPDX-License-Identifier: BSD-3-Clause
// A scan as the surface that its points lie on.
#pragma once
#include <optional>
#include <vector>

#include "cambium/payload.hpp"

namespace map_crispness {

/// One point of each voxel, in a fixed order; points that are not finite are left out.
cambium::Cloud thinned(const cambium::Cloud& cloud, double voxel_size);

/// Not for several threads at once: planes are fitted when they are first needed.
class Surface {
 public:
  explicit Surface(const cambium::Cloud& target);
  ~Surface();

  /// Distances [m] to the plane through the nearest target points, for the points of `source` that
  /// have a target point within `radius` [m] which lies on something flat.
  std::vector<double> distances(const cambium::Cloud& source, const cambium::SE3& T_target_source,
                                double radius);

 private:
  struct Plane {
    Eigen::Vector3d center, normal;
  };
  struct Tree;
  const std::optional<Plane>& plane_at(int index);

  std::unique_ptr<Tree> tree_;
  std::vector<std::optional<std::optional<Plane>>> planes_;  // [point]; fitted, flat
};

}  // namespace map_crispness
