// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "engine/engine.hpp"
#include "engine/resolve.hpp"

namespace cambium {

/// Expands globs, finds a reader for each path, reads all missions side by side and puts them into
/// an atlas, ordered by name, each an island of its own. Throws Error(config) for a path that names
/// nothing, Error(data) for missions that cannot be read or share a name.
Atlas read_missions(const Pipeline& pipeline, const Registry& registry, const Engine& engine);

}  // namespace cambium
