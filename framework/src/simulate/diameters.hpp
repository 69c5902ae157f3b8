// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/spec.hpp"
#include "simulate/thinning.hpp"

namespace cambium::simulate {

/// Shape and scale of Weibull's distribution with this mean and standard deviation.
struct Weibull {
  double shape, scale;
};
Weibull weibull_from(double mean, double sd);

/// Diameters at breast height [m] of the stems at these places, Weibull's as a whole. The thick
/// ones keep the distance `dominance` from one another, since they took the light of their
/// neighbours: 0 hands them out at random.
std::vector<double> diameters(const StandSpec& spec, const std::vector<Place>& places,
                              std::uint64_t seed);

double naslund_height(double dbh, double a, double b);  ///< [m]

}  // namespace cambium::simulate
