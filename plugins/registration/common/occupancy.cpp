// SPDX-License-Identifier: BSD-3-Clause
#include "common/occupancy.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::registration {
namespace {

constexpr float farthest = 60;  // [m] scans are sparse beyond, and the grid is dense

}  // namespace

Eigen::Matrix3Xf upright(const Patches& patches) {
  std::vector<float> xyz;
  for (const Patch& p : patches)
    if (p.normal.head<2>().norm() > 0.7F && p.at.norm() < farthest)
      xyz.insert(xyz.end(), p.at.data(), p.at.data() + 3);
  return Eigen::Map<Eigen::Matrix3Xf>(xyz.data(), 3, Eigen::Index(xyz.size() / 3));
}

Occupancy::Occupancy(const Eigen::Matrix3Xf& points, float cell, const Eigen::Array3i& reach)
    : cell_(cell), reach_(reach), size_(0, 0, 0), origin_(Eigen::Vector3f::Zero()) {
  if (points.cols() == 0) return;
  // Twice the reach and a cell for the neighbours around the points: then a place that is within
  // reach of them stays inside the grid under any shift, and score() need not look.
  const Eigen::Array3i margin = 2 * reach + 1;
  origin_ = points.rowwise().minCoeff().array() - margin.cast<float>() * cell;
  size_ = cell_of(points.rowwise().maxCoeff()) + 1 + margin;
  values_.assign(std::size_t(size_.cast<std::int64_t>().prod()), 0);
  for (Eigen::Index i = 0; i < points.cols(); ++i) mark(cell_of(points.col(i)));
}

void Occupancy::mark(const Eigen::Array3i& centre) {
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        const std::uint8_t value = (x == 0 && y == 0 && z == 0) ? 2 : 1;
        auto& stored = values_[std::size_t(place(centre + Eigen::Array3i(x, y, z)))];
        stored = std::max(stored, value);
      }
}

std::vector<std::int32_t> Occupancy::places(const Eigen::Matrix3Xf& points) const {
  std::vector<std::int32_t> result;
  result.reserve(std::size_t(points.cols()));
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Array3f c = (points.col(i) - origin_).array() / cell_;
    const bool within_reach =
        (c >= reach_.cast<float>()).all() && (c < (size_ - reach_).cast<float>()).all();
    if (within_reach) result.push_back(place(c.cast<int>()));
  }
  return result;
}

int Occupancy::score(const std::vector<std::int32_t>& places, const Eigen::Array3i& shift) const {
  const std::int32_t offset = place(shift);
  int sum = 0;
  for (const std::int32_t p : places) sum += values_[std::size_t(p + offset)];
  return sum;
}

}  // namespace cambium::registration
