// SPDX-License-Identifier: BSD-3-Clause
// What a pair of missions looks like by its own loops alone: the map that later waves of
// recognition look at.
#pragma once
#include <memory>
#include <vector>

#include "engine/mission_pairs.hpp"

namespace cambium {

/// Of each pair the atlas of these missions alone (the reference first; one mission when they are
/// the same), relaxed by `known.relaxed_by` over the accepted loops between and within them.
///
/// It does not change when other missions come, which the map of all does: so what a wave finds in
/// it stays true, and in the cache, when a map grows (docs/decisions/0008). Null where the map of
/// all has to serve: before the first `optimize`, where no loop ties the pair directly, where
/// its loops alone do not determine a map, and where GNSS positions hold the island.
std::vector<std::shared_ptr<const Atlas>> pair_maps(const Known& known,
                                                    const std::vector<PairOfMissions>& pairs,
                                                    const StepScope& scope);

}  // namespace cambium
