// SPDX-License-Identifier: BSD-3-Clause
// What must hold of missions before the first step, and what their user should hear of.
#pragma once
#include "engine/engine.hpp"

namespace cambium {

/// What the engine relies on; a reader that breaks it is named before anything goes wrong: throws
/// Error(data) with the mission's `path`.
void check_mission(const Mission& mission, const std::filesystem::path& path);

/// Throws Error(data) when two of the missions, ordered by name, have the same one.
void check_names(const std::vector<Mission>& missions);

/// The reader's warnings, and those about the mission as a whole.
void warn_of(const Mission& mission, Progress& progress);

/// Pose graphs are in memory for the whole run; payloads come and go. What the process took before
/// it read them (`before` [bytes]: libraries, mostly) is not theirs. Throws Error(config) when they
/// alone take more than the budget.
void check_memory(const Engine& engine, std::size_t missions, std::size_t before);

}  // namespace cambium
