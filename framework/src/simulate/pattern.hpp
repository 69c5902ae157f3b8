// SPDX-License-Identifier: BSD-3-Clause
// Where stems stand.
#pragma once
#include <vector>

#include "simulate/spec.hpp"

namespace cambium::simulate {

struct Place {
  double x, y;         ///< east, north [m]
  std::uint64_t mark;  ///< random; of two that are too near, the lower one stays
};

/// The points that have no other one with a lower mark nearer than `hard_core`: Matern's second
/// process (Matern 1960) when the points are Poisson's. Ordered as given.
std::vector<Place> thinned(const std::vector<Place>& points, double hard_core);

/// Places of the stems within the area, without its clearings.
std::vector<Place> stem_places(const StandSpec& spec, std::uint64_t seed);

/// Independent places within the area, `density` a hectare.
std::vector<Place> poisson_places(const std::vector<double>& size, double density,
                                  std::uint64_t seed, std::string_view purpose);

/// Without those in a circle; `circles` are x, y, radius, ...
std::vector<Place> outside(const std::vector<double>& circles, std::vector<Place> places);

}  // namespace cambium::simulate
