// SPDX-License-Identifier: BSD-3-Clause
// The ground: heights on a grid of 1 m, bilinear between. World frame: east, north, up.
#pragma once
#include <vector>

#include "cambium/se3.hpp"
#include "simulate/spec.hpp"

namespace cambium::simulate {

struct Terrain {
  static constexpr double cell = 1.0;  // [m]
  double x0 = 0, y0 = 0;               ///< of the south-west corner
  int nx = 0, ny = 0;                  ///< cells
  std::vector<float> heights;          ///< (nx + 1) x (ny + 1), row by row from the south-west

  float at(int ix, int iy) const { return heights[std::size_t(iy) * std::size_t(nx + 1) + ix]; }
  double height(double x, double y) const;  ///< beyond the edge, that of the edge
};

/// Three octaves of value noise, scaled so that the steepest slope is the one asked for.
/// `size` is that of the stand.
Terrain make_terrain(const TerrainSpec& spec, const std::vector<double>& size, std::uint64_t seed);

}  // namespace cambium::simulate
