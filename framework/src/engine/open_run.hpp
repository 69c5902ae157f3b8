// SPDX-License-Identifier: BSD-3-Clause
// A finished run, read again.
#pragma once
#include "engine/steps.hpp"
#include "pipeline/pipeline.hpp"
#include "plugins/loader.hpp"

namespace cambium {

/// Whether `cambium run --out` wrote the folder, and came to its end.
bool is_run(const std::filesystem::path& folder);

/// The pipeline of a run, without its steps. Throws Error(config) when the folder holds none.
Pipeline missions_of_run(const std::filesystem::path& run);

/// The pipeline of a run with its filters only: what its payloads were at its end. Throws as above.
Pipeline filters_of_run(const std::filesystem::path& run);

/// Its missions at their poses in the map, with loops and georeferences.
Atlas open_run(const std::filesystem::path& run, const Registry& registry, const Engine& engine);

/// The same, with the streams of payloads that the run's filters made.
Known reopen_run(const std::filesystem::path& run, const Registry& registry, const Engine& engine);

/// Each run folder among the missions replaced by the missions it was made from, so that a map
/// grows by naming it: what its missions have in common is in the cache. A mission named twice in
/// this way stays once.
std::vector<MissionSpec> without_runs(const std::vector<MissionSpec>& missions);

}  // namespace cambium
