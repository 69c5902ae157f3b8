// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "cambium/atlas.hpp"

namespace cambium {

/// Joins islands that accepted loops tie together: each becomes a rigid body, and the transform
/// between two bodies is the one that most of their loops agree on, so that single wrong loops do
/// not place a mission. The island of the first mission by name gives the frame.
/// Its georeference and positions stay; those of an island that joins it held in another frame.
/// Returns the atlas with new poses and islands (in order of their first mission).
Atlas join_islands(Atlas atlas);

}  // namespace cambium
