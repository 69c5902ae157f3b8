// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "cambium/atlas.hpp"

namespace cambium {

/// Whether the map frame of the island is the own frame of this mission, so that its priors hold
/// there. The first mission gives the frame, unless it is not level and the map was turned to
/// the vertical of the others.
bool gives_map_frame(const MissionState& state, const Island& island, const Atlas& atlas);

}  // namespace cambium
