// SPDX-License-Identifier: BSD-3-Clause
// Do two loops agree? J. G. Mangelson, D. Dominic, R. M. Eustice, R. Vasudevan, "Pairwise
// consistent measurement set maximization for robust multi-robot map merging", ICRA 2018.
#pragma once
#include "cambium/atlas.hpp"
#include "path.hpp"

namespace cambium::pcm {

/// A loop as this plugin needs it: T_tail_head with its covariance, and where it ties the paths.
struct Measurement {
  SE3 T_tail_head;
  Mat6 covariance = Mat6::Zero();
  std::size_t tail = 0, head = 0;  ///< node indices
};

/// The squared Mahalanobis distance of the cycle tail_i -> head_i -> head_j -> tail_j -> tail_i
/// from the identity (equation 3 of the paper). Under correct loops it is chi-square with 6 degrees
/// of freedom, to first order.
double cycle_distance(const Measurement& i, const Measurement& j, const Path& tails,
                      const Path& heads);

/// That of the cycle tail -> head -> (odometry) -> tail, for a loop within one mission.
double odometry_distance(const Measurement& loop, const Path& path);

/// The value that a chi-square variable with 6 degrees of freedom stays below with `probability`.
double chi_square_6(double probability);

}  // namespace cambium::pcm
