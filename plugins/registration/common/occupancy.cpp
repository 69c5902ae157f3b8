// SPDX-License-Identifier: BSD-3-Clause
#include "common/occupancy.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::registration {
namespace {

constexpr float reach = 60;  // [m] from the sensor: scans are sparse beyond, and the grid is dense

Eigen::Array3i cell_of(const Eigen::Vector3f& p, float cell) {
  return (p / cell).array().floor().cast<int>();
}

}  // namespace

Eigen::Matrix3Xf upright(const Surface& surface) {
  std::vector<float> xyz;
  for (const Point& p : *surface.points)
    if (std::abs(p.normal_z) < 0.7F && p.getVector3fMap().norm() < reach)
      xyz.insert(xyz.end(), {p.x, p.y, p.z});
  return Eigen::Map<Eigen::Matrix3Xf>(xyz.data(), 3, Eigen::Index(xyz.size() / 3));
}

Occupancy::Occupancy(const Eigen::Matrix3Xf& points, float cell)
    : cell_(cell), origin_(Eigen::Vector3f::Zero()), size_(0, 0, 0) {
  if (points.cols() == 0) return;
  // One cell of margin on each side for the neighbours.
  origin_ = points.rowwise().minCoeff().array() - cell;
  size_ = cell_of(points.rowwise().maxCoeff() - origin_, cell) + 2;
  values_.assign(std::size_t(size_.cast<std::int64_t>().prod()), 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) mark(cell_of(points.col(i) - origin_, cell));
}

void Occupancy::mark(const Eigen::Array3i& centre) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const Eigen::Array3i c = centre + Eigen::Array3i(x, y, z);
        const std::uint8_t value = (x == 0 && y == 0 && z == 0) ? 2 : 1;
        auto& stored = values_[(std::size_t(c.z()) * std::size_t(size_.y()) + std::size_t(c.y())) *
                                   std::size_t(size_.x()) + std::size_t(c.x())];
        stored = std::max(stored, value);
      }
}

int Occupancy::score(const Eigen::Matrix3Xf& points, const Eigen::Vector3f& offset) const {
  int sum = 0;
  const Eigen::Vector3f shift = offset - origin_;
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3f c = (points.col(i) + shift).array() / cell_;
    if (!(c >= 0).all() || !(c < size_.cast<float>()).all()) continue;
    const Eigen::Array3i k = c.cast<int>();
    sum += values_[(std::size_t(k.z()) * std::size_t(size_.y()) + std::size_t(k.y())) *
                       std::size_t(size_.x()) + std::size_t(k.x())];
  }
  return sum;
}

}  // namespace cambium::registration
