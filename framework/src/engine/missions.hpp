// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "engine/engine.hpp"
#include "engine/resolve.hpp"

namespace cambium {

/// Expands globs, finds a reader for each path, reads all missions side by side and puts them into
/// an atlas, ordered by name, each an island of its own. Throws Error(config) for a path that names
/// nothing, Error(data) for missions that cannot be read or share a name.
Atlas read_missions(const Pipeline& pipeline, const Registry& registry, const Engine& engine);

/// A mission where its own poses have it, an island of its own.
MissionState initial_state(std::shared_ptr<const Mission> mission, std::uint32_t island);

/// Ids of the fused graph: 10 000 per mission, grown in steps of 10 000 when a mission needs more.
/// Ids that do not start near zero (time stamps, GTSAM symbols) move to the front of the range.
void assign_offsets(std::vector<MissionState>& missions);

}  // namespace cambium
