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

/// A node that points come from.
struct View {
  Eigen::Vector2d position{0, 0};  ///< of the node, levelled frame [m]
  Eigen::Vector2d shift{0, 0};     ///< correction [m]
  double turn = 0;                 ///< correction about the node [rad]

  Eigen::Vector2d corrected(const Eigen::Vector2d& p) const;
};

/// A tree in the levelled frame.
struct Found {
  Stem stem;          ///< x and y from the origin of the frame
  double ground = 0;  ///< at the stem [m]
  Judgement judgement;
  Eigen::Vector3d base() const;  ///< where the axis meets the ground
};

/// Fitted on distances across their surfaces.
std::vector<Found> find_trees(const std::vector<Above>& points, const Ground& ground,
                              const Limits& limits, std::uint64_t seed);

/// The trees after their points have moved a little, fitted along the rays that come from the
/// views; without those that no longer hold.
std::vector<Found> fitted_again(const std::vector<Found>& trees, const std::vector<Above>& points,
                                const std::vector<View>& views, const Limits& limits);

}  // namespace stem_extraction
