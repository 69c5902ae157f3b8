// SPDX-License-Identifier: BSD-3-Clause
// Very many scans at little cost: a world without end, whose heights are hashed from the
// coordinates.
#pragma once
#include "support/support.hpp"

namespace cambium::bench {

enum class World {
  town,   ///< blocks, trees and open ground; a path of 1 m steps never returns to itself
  alike,  ///< the same surroundings everywhere, up to noise of some per cent of the heights
};

/// A mission whose node i stands `beside` [m] the path at steps[i]. The heading is hashed, too.
/// Scans have a point in each bin of 20 x 60 that is in view; they are made when they are loaded.
Mission made_up_mission(World world, const std::string& name, const std::vector<std::size_t>& steps,
                        double beside);

}  // namespace cambium::bench
