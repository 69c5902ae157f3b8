// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <set>

#include "cambium/atlas.hpp"
#include "cambium/pose_graph.hpp"

namespace cambium {

/// The pose graph of one island, and where its parts come from.
struct IslandGraph {
  PoseGraph graph;
  std::vector<NodeRef> nodes;      ///< graph node -> atlas node
  std::vector<std::size_t> loops;  ///< the last relative factors, in order -> atlas.loops
};

/// Factors: the edges of the missions, their priors where the island's frame is that of the
/// mission, the island's positions, the accepted loops, and attitude factors when `attitude_sigma`
/// [rad] is above 0, but not of the missions that are `not_level`. The gauge: FIX lines of the first mission, else its first node, unless priors
/// or positions hold the graph.
/// `warn` hears of what could not be used.
IslandGraph build_graph(const Atlas& atlas, std::uint32_t island, double attitude_sigma,
                        const std::set<std::uint32_t>& not_level,
                        const std::function<void(const std::string&)>& warn);

}  // namespace cambium
