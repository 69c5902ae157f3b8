// SPDX-License-Identifier: BSD-3-Clause
#include "common/density.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace columns {
namespace {

/// The bin of a point, or nothing (-1) when it is outside.
long bin(float x, float y, const DensityGrid& g) {
  if (g.polar) {
    const double ring = std::hypot(double(x), double(y)) * g.rows / g.max_range;
    if (!(ring < g.rows)) return -1;
    double turns = std::atan2(double(y), double(x)) / (2.0 * std::numbers::pi);
    turns -= std::floor(turns);
    return long(ring) * g.cols + std::min(long(turns * g.cols), long(g.cols) - 1);
  }
  const double col = (double(x) / g.max_range + 1.0) * 0.5 * g.cols;
  const double row = (double(y) / g.max_range + 1.0) * 0.5 * g.rows;
  if (!(col >= 0 && col < g.cols && row >= 0 && row < g.rows)) return -1;
  return long(row) * g.cols + long(col);
}

}  // namespace

void density_image(const cambium::Cloud::Matrix3X& points, const DensityGrid& grid,
                   std::span<float> image) {
  std::fill(image.begin(), image.end(), 0.0f);
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const double z = points(2, i);
    if (z < grid.lowest || z > grid.highest) continue;
    const long at = bin(points(0, i), points(1, i), grid);
    if (at >= 0) image[std::size_t(at)] += 1.0f;
  }
  for (float& value : image) value = std::log1p(value);
  const float largest = image.empty() ? 0.0f : *std::max_element(image.begin(), image.end());
  if (largest > 0)
    for (float& value : image) value /= largest;
}

}  // namespace columns
