// SPDX-License-Identifier: BSD-3-Clause
#include "ground.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace stem_extraction {
namespace {

using Eigen::Vector3f;

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr float roughness = 0.2f;  // of the ground within a cell, stones and moss [m]

float distance(const Vector3f& a, const Vector3f& b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

}  // namespace

template <class Visit>
void Ground::around(int ix, int iy, int reach, Visit visit) const {
  for (int y = std::max(0, iy - reach); y <= std::min(width_ - 1, iy + reach); ++y)
    for (int x = std::max(0, ix - reach); x <= std::min(width_ - 1, ix + reach); ++x)
      if (const Vector3f& p = lowest_[std::size_t(index(x, y))]; !std::isnan(p.z())) visit(p);
}

Ground::Ground(const std::vector<Vector3f>& points, double range, const GroundLimits& limits)
    : limits_(limits), range_(range), width_(int(std::ceil(2 * range / limits.cell))) {
  take_lowest(points);
  drop_low_outliers();
  drop_what_stands_on_the_ground();
  heights_.reserve(std::size_t(width_ + 1) * std::size_t(width_ + 1));
  for (int iy = 0; iy <= width_; ++iy)
    for (int ix = 0; ix <= width_; ++ix)
      heights_.push_back(
          plane_at(float(ix * limits_.cell - range_), float(iy * limits_.cell - range_)));
}

void Ground::take_lowest(const std::vector<Vector3f>& points) {
  constexpr float thick = 0.15f;  // of the ground in a submap: noise and tilt of its scans [m]
  std::vector<float> lowest(std::size_t(width_ * width_), std::numeric_limits<float>::max());
  for (const Vector3f& p : points)
    if (const int i = cell_of(p); i >= 0)
      lowest[std::size_t(i)] = std::min(lowest[std::size_t(i)], p.z());
  std::vector<Eigen::Vector4d> sums(lowest.size(), Eigen::Vector4d::Zero());
  for (const Vector3f& p : points)
    if (const int i = cell_of(p); i >= 0 && p.z() < lowest[std::size_t(i)] + thick)
      sums[std::size_t(i)] += p.cast<double>().homogeneous();
  for (const Eigen::Vector4d& s : sums)
    lowest_.push_back(s[3] > 0 ? Vector3f(s.hnormalized().cast<float>()) : Vector3f(0, 0, unknown));
}

int Ground::cell_of(const Vector3f& p) const {
  const int ix = int(std::floor((p.x() + range_) / limits_.cell));
  const int iy = int(std::floor((p.y() + range_) / limits_.cell));
  return ix < 0 || iy < 0 || ix >= width_ || iy >= width_ ? -1 : index(ix, iy);
}

// Echoes from below the ground are lone: nearly all of their neighbours lie higher than a slope
// explains.
void Ground::drop_low_outliers() {
  const float slope = float(std::tan(limits_.max_slope));
  std::vector<int> dropped;
  for (int i = 0; i < width_ * width_; ++i) {
    const Vector3f& p = lowest_[std::size_t(i)];
    if (std::isnan(p.z())) continue;
    int higher = 0, all = -1;  // without the point itself
    around(i % width_, i / width_, 3, [&](const Vector3f& q) {
      ++all;
      higher += q.z() - p.z() > slope * distance(p, q) + roughness;
    });
    if (all > 0 && higher > 0.75 * all) dropped.push_back(i);
  }
  for (const int i : dropped) lowest_[std::size_t(i)].z() = unknown;
}

void Ground::drop_what_stands_on_the_ground() {
  const float slope = float(std::tan(limits_.max_slope));
  const int reach = int(std::ceil(6.0 / limits_.cell));
  std::vector<int> order;
  for (int i = 0; i < width_ * width_; ++i)
    if (!std::isnan(lowest_[std::size_t(i)].z())) order.push_back(i);
  const auto z = [&](int i) { return lowest_[std::size_t(i)].z(); };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return z(a) < z(b); });
  // From the lowest up; what is dropped no longer speaks against others.
  std::vector<Vector3f> all(lowest_.size(), Vector3f(0, 0, unknown));
  std::swap(all, lowest_);
  for (const int i : order) {
    const Vector3f& p = all[std::size_t(i)];
    bool stands = false;
    around(i % width_, i / width_, reach, [&](const Vector3f& q) {
      stands = stands || p.z() - q.z() > slope * distance(p, q) + roughness;
    });
    if (!stands) lowest_[std::size_t(i)] = p;
  }
}

float Ground::plane_at(float x, float y) const {
  constexpr std::size_t enough = 6;
  const int ix = int(std::lround((x + range_) / limits_.cell));
  const int iy = int(std::lround((y + range_) / limits_.cell));
  std::vector<Vector3f> near;
  for (int reach = 2; near.size() < enough; reach *= 2) {
    if (reach * limits_.cell > 9.0) return unknown;
    near.clear();
    around(ix, iy, reach, [&](const Vector3f& p) { near.push_back(p - Vector3f(x, y, 0)); });
  }
  Eigen::Vector3d plane(0, 0, 0);
  for (int iteration = 0; iteration < 5; ++iteration) {
    Eigen::Matrix3d H = 1e-3 * Eigen::Matrix3d::Identity();  // nearly level where nothing is known
    H(2, 2) = 1e-9;
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
    for (const Vector3f& p : near) {
      const Eigen::Vector3d J(p.x(), p.y(), 1);
      // What is above the plane is likelier not ground than what is below.
      const double r = double(p.z()) - J.dot(plane), scale = r > 0 ? 0.1 : 0.3;
      const double weight = iteration == 0 ? 1 : 1 / (1 + r * r / (scale * scale));
      H += weight * J * J.transpose();
      b += weight * double(p.z()) * J;
    }
    plane = H.ldlt().solve(b);
  }
  return float(plane.z());
}

float Ground::height(float x, float y) const {
  const float u = std::clamp(float((x + range_) / limits_.cell), 0.f, float(width_) - 1e-3f);
  const float v = std::clamp(float((y + range_) / limits_.cell), 0.f, float(width_) - 1e-3f);
  const int ix = int(u), iy = int(v);
  const float a = u - float(ix), b = v - float(iy);
  const auto at = [&](int i, int j) { return heights_[std::size_t(j * (width_ + 1) + i)]; };
  return (1 - b) * ((1 - a) * at(ix, iy) + a * at(ix + 1, iy)) +
         b * ((1 - a) * at(ix, iy + 1) + a * at(ix + 1, iy + 1));
}

}  // namespace stem_extraction
