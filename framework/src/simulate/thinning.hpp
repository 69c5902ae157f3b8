// SPDX-License-Identifier: BSD-3-Clause
// Which of many places are too near to one another.
#pragma once
#include <cstdint>
#include <vector>

namespace cambium::simulate {

struct Place {
  double x, y;         ///< east, north [m]
  std::uint64_t mark;  ///< random; of two that are too near, the lower one stays
};

/// The places that have no other one with a lower mark nearer than `distance`, in their order:
/// Matern's second process (Matern 1960) when the places are Poisson's.
std::vector<Place> thinned(const std::vector<Place>& places, double distance);

/// For every place, whether it is one of a set that keep `distance` from one another: taken in the
/// order of their marks, each that is far enough from those taken before (random sequential
/// adsorption). Denser than thinned(): a place only yields to one that stays itself.
std::vector<bool> spread(const std::vector<Place>& places, double distance);

}  // namespace cambium::simulate
