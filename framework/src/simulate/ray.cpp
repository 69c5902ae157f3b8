// SPDX-License-Identifier: BSD-3-Clause
// Ray casting: a ray visits the columns of the scene one after another (Amanatides, Woo 1987).
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/scene.hpp"

namespace cambium::simulate {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float slack = 1e-4f;  // of a hit beside the border of a column [m]

/// 1 / d; where d is 0, so large that a border is out of reach, but no infinity: 0 * infinity is
/// NaN.
float inverse(float d) { return d == 0 ? 1e30f : 1 / d; }

/// Cuts [begin, end] down to where the ray is within [low, high] along one axis.
void clip(float origin, float direction, float low, float high, float& begin, float& end) {
  if (direction == 0) {
    if (origin < low || origin > high) end = -1;
    return;
  }
  const float a = (low - origin) / direction, b = (high - origin) / direction;
  begin = std::max(begin, std::min(a, b));
  end = std::min(end, std::max(a, b));
}

}  // namespace

/// The part of a ray within one column, from `begin` to `end` along it. x and y count from the
/// scene's corner, so that a column is [ix, ix + 1] x [iy, iy + 1].
struct Scene::Segment {
  int ix, iy;
  Eigen::Vector3f entry, direction;
  float begin, end;
  float lowest;  ///< height [m]
};

float Cone::hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction) const {
  const Eigen::Vector3f from_base = origin - base;
  const float along0 = from_base.dot(axis), along1 = direction.dot(axis);
  const Eigen::Vector3f out0 = from_base - along0 * axis, out1 = direction - along1 * axis;
  const float taper = -radius / length;
  const float r0 = radius + taper * along0, r1 = taper * along1;
  // |out0 + t out1|^2 = (r0 + t r1)^2
  const float a = out1.squaredNorm() - r1 * r1, b = out0.dot(out1) - r0 * r1;
  const float c = out0.squaredNorm() - r0 * r0;
  const float root = b * b - a * c;
  if (root < 0 || a <= 0) return -1;
  const float t = (-b - std::sqrt(root)) / a;
  const float along = along0 + t * along1;
  return along >= 0 && along <= length ? t : -1;
}

void Scene::hit_cones(const Column& column, const Segment& s, Hit& hit) const {
  for (std::uint32_t i = column.first; i < column.first + column.cones; ++i) {
    const std::uint32_t index = cones_in_[i];
    const float t = cones_[index].hit(s.entry, s.direction);
    // Farther hits belong to the next column, where something else may be nearer.
    if (t < -slack || s.begin + t > s.end + slack || s.begin + t >= hit.range) continue;
    hit.range = s.begin + t;
    hit.surface = index < stem_count_ ? Surface::stem : Surface::clutter;
    hit.stem = index < stem_count_ ? index : index - std::uint32_t(stem_count_);
  }
}

void Scene::hit_ground(const Segment& s, Hit& hit) const {
  const auto row = std::size_t(s.iy) * std::size_t(nx_ + 1) + std::size_t(s.ix);
  const float h00 = ground_[row], h10 = ground_[row + 1];
  const float h01 = ground_[row + std::size_t(nx_) + 1], h11 = ground_[row + std::size_t(nx_) + 2];
  const float u = s.entry.x() - float(s.ix), v = s.entry.y() - float(s.iy);
  const float du = s.direction.x(), dv = s.direction.y();
  const float east = h10 - h00, north = h01 - h00, twist = h11 - h10 - h01 + h00;
  // Height over the bilinear ground: a t^2 + b t + c.
  const float a = -twist * du * dv;
  const float b = s.direction.z() - east * du - north * dv - twist * (u * dv + v * du);
  const float c = s.entry.z() - h00 - east * u - north * v - twist * u * v;
  float t = infinity;
  if (c <= 0) {
    t = 0;  // the border of two columns, within rounding
  } else if (const float root = b * b - 4 * a * c; root >= 0) {
    // The stable form of the smaller positive root; there is one when `sum` is positive.
    const float sum = -b + std::sqrt(root);
    if (sum > 0) t = 2 * c / sum;
  }
  if (t > s.end - s.begin + slack || s.begin + t >= hit.range) return;
  hit.range = s.begin + t;
  hit.surface = Surface::ground;
}

bool Scene::hit_leaves(const Column& column, const Segment& s, float& depth, Hit& hit) const {
  const float stop = std::min(s.end, hit.range), z = s.entry.z() - layer_zero_;
  const int up = s.direction.z() > 0;
  const float per_layer = inverse(s.direction.z());
  const float* const extinction =
      leaves_.data() + std::size_t(s.iy * nx_ + s.ix) * std::size_t(layers_);
  int layer = z < 0 ? -1 : int(z);  // the ground is nowhere below layer 0
  for (float t = s.begin; t < stop; layer += up ? 1 : -1) {
    if (up ? layer >= column.leaf_end : layer < column.leaf_begin) return false;
    const float border = (float(layer + up) - z) * per_layer;
    const float next = std::clamp(s.begin + std::abs(border), t, stop);
    if (layer >= column.leaf_begin && layer < column.leaf_end) {
      const float used = extinction[layer] * (next - t);
      if (used > depth) {
        hit.range = t + depth / extinction[layer];
        hit.surface = Surface::foliage;
        return true;
      }
      depth -= used;
    }
    t = next;
  }
  return false;
}

Hit Scene::cast(const Eigen::Vector3f& origin_world, const Eigen::Vector3f& direction,
                float max_range, float optical_depth) const {
  const Eigen::Vector3f origin(origin_world.x() - corner_.x(), origin_world.y() - corner_.y(),
                               origin_world.z());
  float begin = 0, end = max_range;
  clip(origin.x(), direction.x(), 0, float(nx_), begin, end);
  clip(origin.y(), direction.y(), 0, float(ny_), begin, end);
  clip(origin.z(), direction.z(), -infinity, top_, begin, end);
  Hit hit;
  hit.range = end + slack;
  int ix = std::clamp(int(origin.x() + begin * direction.x()), 0, nx_ - 1);
  int iy = std::clamp(int(origin.y() + begin * direction.y()), 0, ny_ - 1);
  const int east = direction.x() >= 0, north = direction.y() >= 0;
  const float per_column = inverse(direction.x()), per_row = inverse(direction.y());
  while (begin < end && hit.surface == Surface::none) {
    const float at_x = (float(ix + east) - origin.x()) * per_column;
    const float at_y = (float(iy + north) - origin.y()) * per_row;
    const float out = std::clamp(std::min(at_x, at_y), begin, end);
    const float z = origin.z() + begin * direction.z();
    const float z_out = origin.z() + out * direction.z();
    const Segment s{ix, iy, origin + begin * direction, direction, begin, out, std::min(z, z_out)};
    const Column& column = columns_[std::size_t(iy * nx_ + ix)];
    if (s.lowest <= column.ground) hit_ground(s, hit);
    if (column.cones > 0 && s.lowest <= column.top) hit_cones(column, s, hit);
    if (column.leaf_end > 0 && hit_leaves(column, s, optical_depth, hit)) break;
    begin = out;
    (at_x < at_y ? ix : iy) += at_x < at_y ? 2 * east - 1 : 2 * north - 1;
    if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) break;
  }
  return hit;
}

}  // namespace cambium::simulate
