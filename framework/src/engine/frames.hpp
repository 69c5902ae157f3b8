// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

#include "cambium/atlas.hpp"

namespace cambium {

/// Joins islands that accepted loops tie together. Each is a rigid body; its frame comes from all
/// loops between all of them at once (fit_pair, then average_frames), so that neither single wrong
/// loops nor a pair of missions whose loops are all wrong place a mission. The loops of a pair that
/// contradicts the others by more than missions bend (1 m and 2 % of the path between the ties)
/// are rejected, with the reason, and `warn` hears of the pair.
/// The island of the first mission by name gives the frame. Its georeference and positions stay;
/// those of an island that joins it held in another frame.
/// Returns the atlas with new poses and islands (in order of their first mission).
Atlas join_islands(Atlas atlas, const std::function<void(const std::string&)>& warn);

}  // namespace cambium
