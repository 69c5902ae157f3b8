// SPDX-License-Identifier: BSD-3-Clause
// Where stems stand.
#pragma once
#include <string_view>
#include <vector>

#include "simulate/spec.hpp"
#include "simulate/thinning.hpp"

namespace cambium::simulate {

/// Places of the stems within the area, without its clearings.
std::vector<Place> stem_places(const StandSpec& spec, std::uint64_t seed);

/// Independent places within the area, `density` a hectare.
std::vector<Place> poisson_places(const std::vector<double>& size, double density,
                                  std::uint64_t seed, std::string_view purpose);

/// Without those in a circle; `circles` are x, y, radius, ...
std::vector<Place> outside(const std::vector<double>& circles, std::vector<Place> places);

}  // namespace cambium::simulate
