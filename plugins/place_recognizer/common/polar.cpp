// SPDX-License-Identifier: BSD-3-Clause
#include "common/polar.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace columns {
namespace {

/// The azimuth of (x, y) in turns, 0..1. With several viewpoints this is where the time goes, so
/// the arctangent is a polynomial (Abramowitz, Stegun 1964, 4.4.49): 1e-5 rad, 1 mm at 80 m.
float turns(float x, float y) {
  const float ax = std::abs(x), ay = std::abs(y);
  const float larger = std::max(ax, ay);
  if (larger == 0.0f) return 0.0f;
  const float t = std::min(ax, ay) / larger, t2 = t * t;
  float angle = t * (0.9998660f +
                     t2 * (-0.3302995f + t2 * (0.1801410f + t2 * (-0.0851330f + t2 * 0.0208351f))));
  constexpr float pi = std::numbers::pi_v<float>;
  if (ay > ax) angle = 0.5f * pi - angle;
  if (x < 0) angle = pi - angle;
  if (y < 0) angle = 2.0f * pi - angle;
  return angle / (2.0f * pi);
}

}  // namespace

// Bins start at 0 = empty, so taking the maximum also discards what is lower than -height_offset.
void describe(const cambium::Cloud::Matrix3X& points, const PolarGrid& grid,
              const Eigen::Vector2f& viewpoint, std::span<float> columns) {
  std::fill(columns.begin(), columns.end(), 0.0f);
  const float rings_per_metre = float(grid.shape.rings / grid.max_range);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const float x = points(0, i) - viewpoint.x(), y = points(1, i) - viewpoint.y();
    const float ring = std::sqrt(x * x + y * y) * rings_per_metre;
    if (!(ring < float(grid.shape.rings))) continue;
    const int sector =
        std::min(int(turns(x, y) * float(grid.shape.sectors)), grid.shape.sectors - 1);
    float& bin = columns[std::size_t(sector * grid.shape.rings + int(ring))];
    bin = std::max(bin, points(2, i) + float(grid.height_offset));
  }
  Eigen::Map<Eigen::MatrixXf> by_sector(columns.data(), grid.shape.rings, grid.shape.sectors);
  for (auto column : by_sector.colwise()) column.stableNormalize();
}

}  // namespace columns
