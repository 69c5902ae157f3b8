// SPDX-License-Identifier: BSD-3-Clause
// What an `optimize` step does to an atlas, in parts.
#pragma once
#include "engine/graph.hpp"
#include "engine/steps.hpp"

namespace cambium {

/// Joins the islands that accepted loops tie together, and returns the graph of each island; `warn`
/// hears of what does not fit.
std::vector<IslandGraph> relaxation_graphs(Atlas& atlas, const StepKeys& keys,
                                           const std::function<void(const std::string&)>& warn);

/// Solves one of them with the step's solver, or takes the solution from the cache. Throws
/// Error(numeric) when it is not one.
Solution relax(const IslandGraph& island, const StepScope& scope, Making& making);

/// Puts the missions of the island where the solution has them, and tells its loops.
void place(const Solution& solution, const IslandGraph& island, Atlas& atlas);

}  // namespace cambium
