// SPDX-License-Identifier: BSD-3-Clause
// Leaves and needles as a grid of extinction coefficients: a ray survives a path of length s with
// probability exp(-extinction * s) (Beer-Lambert).
#pragma once
#include <vector>

#include "simulate/stand.hpp"

namespace cambium::simulate {

struct Foliage {
  int nx = 0, ny = 0, layers = 0;  ///< voxels of Terrain::cell, over the columns of the terrain
  double bottom = 0;               ///< height of the lowest layer [m]
  std::vector<float> extinction;   ///< [1/m]; layers of a column lie side by side

  float& at(int ix, int iy, int layer) {
    return extinction[(std::size_t(iy) * std::size_t(nx) + std::size_t(ix)) * std::size_t(layers) +
                      std::size_t(layer)];
  }
};

/// Ellipsoidal crowns around the stems, and an understory over the ground. Clearings have no trees,
/// so they have no crowns; they keep their grass.
Foliage grow(const FoliageSpec& spec, const StandSpec& stand, const Terrain& terrain,
             const std::vector<Stem>& stems, std::uint64_t seed);

}  // namespace cambium::simulate
