// SPDX-License-Identifier: BSD-3-Clause
// The turn and shift that most matched features agree on.
#pragma once
#include <span>

#include "features.hpp"

namespace bev_density {

struct ConsensusOptions {
  double tolerance = 1.0;  ///< between a feature and the one that it was matched with [m]
  int hypotheses = 60;     ///< the most alike matches, of which every two make a hypothesis
};

struct Consensus {
  std::size_t inliers = 0;
  cambium::SE3 T_reference_query;  ///< yaw and translation, between the levelled frames
};

/// Every two of the most alike matches that are as far apart in both pictures fix a turn and a
/// shift; the one that most matches agree with is fitted to all of these (Umeyama, PAMI 1991). What
/// RANSAC draws at random is tried out here, so there is no seed. No inliers: no two agree.
Consensus agree(const Features& query, const Features& reference,
                std::span<const FeatureMatch> matches, const ConsensusOptions& options);

}  // namespace bev_density
