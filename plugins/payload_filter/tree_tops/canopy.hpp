// SPDX-License-Identifier: BSD-3-Clause
// Ground and tree tops in a cloud that was taken from above, on a grid. z is up.
#pragma once
#include <vector>

#include "cambium/payload.hpp"

namespace tree_tops {

struct Limits {
  double ground_cell = 2.0;    ///< the lowest point in a cell this wide may be ground [m]
  double max_slope = 35;       ///< of the ground; what rises faster from it is vegetation [deg]
  double cell = 0.5;           ///< of the canopy's surface [m]
  double min_height = 5;       ///< of a tree [m]
  double crown = 0.8;          ///< no higher point lies so near to a top [m] ...
  double crown_growth = 0.06;  ///< ... and so much farther per metre of the tree's height [m/m]
};

/// A local maximum of the canopy, and the ground below it.
struct Top {
  cambium::Vec3 base = cambium::Vec3::Zero();
  double height = 0;  ///< above the ground [m]
};

/// In the order of x, then y. Points that are not finite are left out. The ground is the upper
/// envelope that no lowest point lies under by more than the slope allows: a cell in which the
/// canopy hides the ground takes it, smoothly, from those around.
std::vector<Top> find_tops(const cambium::Cloud& levelled, const Limits& limits);

}  // namespace tree_tops
