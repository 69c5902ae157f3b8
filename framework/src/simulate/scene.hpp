// SPDX-License-Identifier: BSD-3-Clause
// What rays meet. Columns of 1 m with the stems that touch them, the ground of the column, and the
// extinction of its foliage in layers of 1 m; single precision, so that a column fits a cache line.
#pragma once
#include <cstdint>
#include <vector>

#include "simulate/foliage.hpp"
#include "simulate/stand.hpp"

namespace cambium::simulate {

enum class Surface : std::uint8_t { none, ground, stem, clutter, foliage };

struct Hit {
  float range = 0;  ///< [m]
  Surface surface = Surface::none;
  std::uint32_t stem = 0;  ///< index into the stems, or into the clutter
};

/// A cone: radius `radius` at the base, falling to 0 at `length` along the axis.
struct Cone {
  Eigen::Vector3f base, axis;
  float radius, length;
  /// Range of the first hit along origin + range * direction, or a negative number. The origin
  /// must be near: single precision cancels far away.
  float hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const;
};

class Scene {
 public:
  Scene(const Terrain& terrain, const std::vector<Stem>& stems, const std::vector<Stem>& clutter,
        const Foliage& foliage);

  /// First surface on the ray from `origin` (world frame) along the unit vector `direction`, up to
  /// `max_range`. The ray passes foliage up to the optical depth `optical_depth`: draw it from an
  /// exponential distribution of mean 1 for each ray (Beer-Lambert).
  Hit cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float max_range,
           float optical_depth) const;

 private:
  struct Column {
    std::uint32_t first = 0;  ///< into cones_in_
    std::uint16_t cones = 0;
    std::uint16_t leaf_begin = 0, leaf_end = 0;  ///< layers with foliage
    float ground = 0;                            ///< highest of the ground [m]
    float top = 0;                               ///< highest of the cones [m]
  };
  struct Segment;
  void add_cones(const std::vector<Stem>& stems);
  void index_cones();
  void take_foliage(const Foliage& foliage);
  void hit_ground(const Segment& s, Hit& hit) const;
  void hit_cones(const Column& column, const Segment& s, Hit& hit) const;
  bool hit_leaves(const Column& column, const Segment& s, float& depth, Hit& hit) const;

  Eigen::Vector2f corner_;
  int nx_, ny_;
  std::vector<float> ground_;  ///< (nx + 1) x (ny + 1)
  std::vector<Column> columns_;
  std::vector<Cone> cones_;  ///< stems, then clutter; x and y from the corner
  std::vector<std::uint32_t> cones_in_;
  std::size_t stem_count_;
  float layer_zero_ = 0;  ///< height of the lowest layer of foliage [m]
  int layers_ = 0;
  std::vector<float> leaves_;  ///< extinction [1/m], columns x layers
  float top_ = 0;              ///< nothing is higher [m]
};

}  // namespace cambium::simulate
