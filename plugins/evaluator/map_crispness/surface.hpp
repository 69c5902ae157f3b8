// SPDX-License-Identifier: BSD-3-Clause
// A scan as the surfaces that its points lie on: ground, and what stands up (stems, walls).
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "cambium/payload.hpp"

namespace map_crispness {

using cambium::Vec3;

/// One point of each voxel, in a fixed order; points that are not finite are left out.
cambium::Cloud thinned(const cambium::Cloud& cloud, double voxel_size);

enum class Kind { ground, upright };

/// A point of another scan on this one's surface.
struct Contact {
  Vec3 p_source, p_target;
  double distance = 0;  ///< to the plane through the nearest points [m]
  Kind kind = Kind::ground;
};

/// Not for several threads at once: planes are fitted when they are first needed.
class Surface {
 public:
  /// `up` is the vertical in the frame of the scan.
  Surface(const cambium::Cloud& scan, const Vec3& up);
  ~Surface();

  /// The points of `source` that have a point of this scan within `radius` [m] which lies on ground
  /// or on something upright. Leaves are left out: they would hide how well the rest agrees.
  std::vector<Contact> contacts(const cambium::Cloud& source, const cambium::SE3& T_this_source,
                                double radius);

  /// The points of this scan within `radius` [m] of p.
  std::vector<Vec3> around(const Vec3& p, double radius);

 private:
  struct Plane {
    Vec3 center, normal;
    Kind kind;
  };
  struct Tree;
  const std::optional<Plane>& plane_at(int index);
  std::optional<Plane> fit(int index);

  Vec3 up_;
  std::unique_ptr<Tree> tree_;
  std::vector<std::optional<std::optional<Plane>>> planes_;  // [point]; fitted, usable
};

}  // namespace map_crispness
