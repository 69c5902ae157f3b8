// SPDX-License-Identifier: BSD-3-Clause
// The small forest in which components are tried, seen by two robots.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "cambium/atlas.hpp"

namespace cambium::conformance {

struct World {
  Atlas atlas;                                 ///< two missions, tied by true loops, one island
  std::vector<std::vector<SE3>> T_world_node;  ///< truth, [mission][node]

  /// From node `source` to node `target`, as it truly is.
  SE3 T_target_source(NodeRef target, NodeRef source) const;
};

/// Scans, tree tables and GNSS fixes of a loop that is walked twice, the second time with another
/// offset; deterministic.
World make_world();

/// The atlas with other payloads: one for each node of each mission.
Atlas with_payloads(const Atlas& atlas,
                    const std::function<Payload(NodeRef, const Payload&)>& payload);

/// The first `nodes` nodes of every mission, and the loops between them.
Atlas first_nodes(const Atlas& atlas, std::size_t nodes);

/// Clouds and tables that a robot can bring home on a bad day.
struct OddPayload {
  std::string name;
  Payload payload;
};
std::vector<OddPayload> odd_payloads();

}  // namespace cambium::conformance
