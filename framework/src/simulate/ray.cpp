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

/// Where the ray is within [low, high] along one axis.
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

/// The part of a ray within one column, from `begin` to `end` along it.
struct Scene::Segment {
  const Column& column;
  int ix, iy;
  Eigen::Vector3f entry, direction;
  float begin, end;
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

void Scene::hit_cones(const Segment& s, Hit& hit) const {
  for (std::uint32_t i = s.column.first; i < s.column.first + s.column.cones; ++i) {
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
  const float length = s.end - s.begin;
  const float exit_z = s.entry.z() + length * s.direction.z();
  if (std::min(s.entry.z(), exit_z) > std::max({h00, h10, h01, h11})) return;
  const float u = s.entry.x() - corner_.x() - float(s.ix);
  const float v = s.entry.y() - corner_.y() - float(s.iy);
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
    // The stable form; `sum` is not 0 where the ray comes down on the ground.
    const float sum = -b + std::sqrt(root);
    if (sum > 0) t = 2 * c / sum;
  }
  if (t > length + slack || s.begin + t >= hit.range) return;
  hit.range = s.begin + t;
  hit.surface = Surface::ground;
}

bool Scene::hit_leaves(const Segment& s, float& depth, Hit& hit) const {
  const float stop = std::min(s.end, hit.range);
  const float* const column =
      leaves_.data() + std::size_t(s.iy * nx_ + s.ix) * std::size_t(layers_);
  const float dz = s.direction.z();
  const int step = dz < 0 ? -1 : 1;
  float z = s.entry.z() - layer_zero_;
  int layer = int(std::floor(z));
  for (float t = s.begin; t < stop; layer += step) {
    const float border = float(layer + (dz < 0 ? 0 : 1));
    const float next = dz == 0 ? stop : std::min(stop, s.begin + std::max(0.f, (border - z) / dz));
    if (step > 0 ? layer >= s.column.leaf_end : layer < s.column.leaf_begin) return false;
    if (layer >= s.column.leaf_begin && layer < s.column.leaf_end) {
      const float used = column[layer] * (next - t);
      if (used > depth) {
        hit.range = t + depth / column[layer];
        hit.surface = Surface::foliage;
        return true;
      }
      depth -= used;
    }
    t = std::max(t, next);
    if (dz == 0) break;
  }
  return false;
}

Hit Scene::cast(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction, float max_range,
                float optical_depth) const {
  float begin = 0, end = max_range;
  clip(origin.x() - corner_.x(), direction.x(), 0, float(nx_), begin, end);
  clip(origin.y() - corner_.y(), direction.y(), 0, float(ny_), begin, end);
  clip(origin.z(), direction.z(), -infinity, top_, begin, end);
  Hit hit;
  hit.range = end + slack;
  const Eigen::Vector2f start = origin.head<2>() + begin * direction.head<2>() - corner_;
  int ix = std::clamp(int(start.x()), 0, nx_ - 1), iy = std::clamp(int(start.y()), 0, ny_ - 1);
  const int step_x = direction.x() < 0 ? -1 : 1, step_y = direction.y() < 0 ? -1 : 1;
  const auto border = [](float from, float d, int cell, int step, float c) {
    return d == 0 ? infinity : (c + float(cell + (step > 0)) - from) / d;
  };
  while (begin < end && hit.surface == Surface::none) {
    const float at_x = border(origin.x(), direction.x(), ix, step_x, corner_.x());
    const float at_y = border(origin.y(), direction.y(), iy, step_y, corner_.y());
    const Column& column = columns_[std::size_t(iy * nx_ + ix)];
    const Segment s{column,
                    ix,
                    iy,
                    origin + begin * direction,
                    direction,
                    begin,
                    std::clamp(std::min(at_x, at_y), begin, end)};
    const float lowest = std::min(s.entry.z(), s.entry.z() + (s.end - begin) * direction.z());
    if (lowest <= column.top) {
      hit_ground(s, hit);
      if (column.cones > 0) hit_cones(s, hit);
    }
    if (column.leaf_end > 0 && hit_leaves(s, optical_depth, hit)) break;
    begin = s.end;
    (at_x < at_y ? ix : iy) += at_x < at_y ? step_x : step_y;
    if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) break;
  }
  return hit;
}

}  // namespace cambium::simulate
