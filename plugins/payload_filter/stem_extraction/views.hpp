// SPDX-License-Identifier: BSD-3-Clause
// Where several nodes saw the same stems, what they saw is moved until it agrees on the stems.
#pragma once
#include <vector>

#include "trees.hpp"

namespace stem_extraction {

/// A node that points come from.
struct View {
  Eigen::Vector2d position{0, 0};  ///< of the node, levelled frame [m]
  Eigen::Vector2d shift{0, 0};     ///< correction [m]
  double turn = 0;                 ///< correction about the node [rad]

  Eigen::Vector2d corrected(const Eigen::Vector2d& p) const;
};

/// Drift between the nodes of a submap smears stems by more than their surface is rough, and makes
/// them thicker. Finds the planar correction of each view that lays its points on the stems, and
/// the stems again, in turns; `own` is the view that stays. Then moves all points.
void align_views(std::vector<View>& views, std::size_t own, const FitLimits& limits,
                 std::vector<Found>& trees, std::vector<Above>& points);

}  // namespace stem_extraction
