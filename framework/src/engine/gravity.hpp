// SPDX-License-Identifier: BSD-3-Clause
// Missions whose frame is not level, or is another kind of frame (z forward, z down).
#pragma once
#include <functional>
#include <set>
#include <string>

#include "cambium/atlas.hpp"

namespace cambium {

/// The missions of the island whose vertical, as the map has it, is more than `limit` [rad] off
/// that of most missions, weighted by their nodes; `warn` hears of each, with the angle. Where two
/// parties are equally large, nobody knows who is wrong, and all of them are named. A mission's
/// vertical is the mean over its nodes, so that a bent one counts as a whole.
///
/// Where the first mission, whose frame is the map's, is among those that a majority finds wrong,
/// the island is turned about that mission's first node until the majority's vertical is the map's:
/// else gravity would pull all others away from it.
std::set<std::uint32_t> not_level(Atlas& atlas, std::uint32_t island, double limit,
                                  const std::function<void(const std::string&)>& warn);

}  // namespace cambium
