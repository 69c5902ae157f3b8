// SPDX-License-Identifier: BSD-3-Clause
// Where to start from when the guess is poor: correlative scan matching (Olson, "Real-Time
// Correlative Scan Matching", ICRA 2009) of upright structure over translation and yaw.
#pragma once
#include <vector>

#include "cambium/se3.hpp"
#include "common/surface.hpp"

namespace cambium::registration {

/// Searched around the guess: translations in the target's axes, yaw about the target's z axis.
struct SearchWindow {
  double radius = 0;       ///< horizontal [m]; with `yaw` also 0 nothing is searched
  double height = 0;       ///< up and down [m]
  double yaw = 0;          ///< to either side [rad]
  double step = 1;         ///< of the translation, and the cell of the occupancy grid [m]
  double yaw_step = 0.05;  ///< [rad]
  int hypotheses = 1;      ///< how many distinct starts to return
};

/// The best distinct T_target_source, best first. Never empty: without upright structure, or with
/// nothing to search, it is the guess itself.
std::vector<SE3> search(const Surface& target, const Patches& source, const SE3& guess,
                        const SearchWindow& window);

}  // namespace cambium::registration
