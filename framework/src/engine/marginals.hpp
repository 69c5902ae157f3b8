// SPDX-License-Identifier: BSD-3-Clause
// `marginals: [mission_a/57]` of an optimize step: the uncertainty of chosen nodes.
#pragma once
#include "engine/graph.hpp"

namespace cambium {

/// Asks the solver for the covariance of each node named MISSION/ID, ID as in the mission's own
/// file. Throws Error(config) when there is no such mission or node.
void ask_for_marginals(const Atlas& atlas, const std::vector<std::string>& names,
                       std::vector<IslandGraph>& graphs);

/// The six sigmas of every node that was asked for: "mission_a/57.sigma_x" [m], ...,
/// "mission_a/57.sigma_yaw" [rad]. Empty when the solver gives none.
std::vector<Score> marginal_figures(const Atlas& atlas, const IslandGraph& graph,
                                    const Solution& solution);

}  // namespace cambium
