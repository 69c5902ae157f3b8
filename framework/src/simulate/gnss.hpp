// SPDX-License-Identifier: BSD-3-Clause
// A receiver under canopy: errors that last, an altitude that jumps, and outages.
#pragma once
#include "cambium/geodesy.hpp"
#include "simulate/trajectory.hpp"

namespace cambium::simulate {

/// Fixes at a fixed rate along the true path (straight between nodes). The stated covariance is
/// that of the process; the receiver does not know of its jumps. `start` [s] is the Unix time of
/// the first node, `reference` that of the world's origin.
std::vector<GnssFix> observe(const std::vector<TruePose>& truth, const GnssSpec& spec,
                             std::int64_t start, const Geodetic& reference, std::uint64_t seed);

}  // namespace cambium::simulate
