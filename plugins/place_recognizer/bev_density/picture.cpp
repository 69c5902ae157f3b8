// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace bev_density {

Picture make_picture(const cambium::Cloud::Matrix3X& levelled, const PictureGrid& grid) {
  Picture out;
  out.side = grid.side();
  const std::size_t pixels = std::size_t(out.side) * std::size_t(out.side);
  std::vector<std::uint64_t> filled(pixels, 0);  // a bit a layer
  out.bottom.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  const double per_layer = grid.layers / (grid.highest - grid.lowest);
  for (Eigen::Index i = 0; i < levelled.cols(); ++i) {
    const double x = levelled(0, i), y = levelled(1, i), z = levelled(2, i);
    const double layer = (z - grid.lowest) * per_layer;
    if (!(std::hypot(x, y) < grid.max_range) || !(layer >= 0 && layer < grid.layers)) continue;
    const int col = std::min(int(x / grid.cell + 0.5 * out.side), out.side - 1);
    const int row = std::min(int(y / grid.cell + 0.5 * out.side), out.side - 1);
    const std::size_t at = std::size_t(std::max(row, 0) * out.side + std::max(col, 0));
    filled[at] |= std::uint64_t(1) << int(layer);
    if (!(out.bottom[at] <= float(z))) out.bottom[at] = float(z);
  }
  int fullest = 1;
  for (const std::uint64_t column : filled) fullest = std::max(fullest, std::popcount(column));
  out.brightness.resize(pixels);
  for (std::size_t at = 0; at < pixels; ++at)
    out.brightness[at] = std::uint8_t(255 * std::popcount(filled[at]) / fullest);
  return out;
}

}  // namespace bev_density
