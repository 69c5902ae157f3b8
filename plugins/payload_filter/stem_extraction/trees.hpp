// SPDX-License-Identifier: BSD-3-Clause
// From a levelled cloud to the stems in it.
#pragma once
#include "candidates.hpp"
#include "ground.hpp"
#include "judgement.hpp"

namespace stem_extraction {

struct Limits {
  GroundLimits ground;
  CandidateLimits candidates;
  FitLimits fit;
  double min_height = 3.5;  ///< lower things are snags, shrubs and poles [m]
  double min_score = 0.2;
};

/// A tree in the levelled frame.
struct Found {
  Stem stem;          ///< x and y from the origin of the frame
  double ground = 0;  ///< at the stem [m]
  Judgement judgement;
  Eigen::Vector3d base() const;  ///< where the axis meets the ground
};

std::vector<Found> find_trees(const std::vector<Above>& points, const Ground& ground,
                              const Limits& limits, std::uint64_t seed);

/// The trees after their points have moved a little; without those that no longer hold.
std::vector<Found> fitted_again(const std::vector<Found>& trees, const std::vector<Above>& points,
                                const Limits& limits);

}  // namespace stem_extraction
