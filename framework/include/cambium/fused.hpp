// SPDX-License-Identifier: BSD-3-Clause
// What comes out: the missions of an island as one pose graph, and their trajectories.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/files.hpp"

namespace cambium {

/// Where the mission's own frame lies in the map. Relaxation bends a mission, so this is taken at
/// its first node, where odometry starts. Identity for a mission without nodes.
SE3 T_map_mission(const MissionState& state);

/// The georeference of the island, or else that of its first mission that has one, carried along
/// with that mission's frame.
std::optional<GeoReference> georeference(const Atlas& atlas, const Island& island);

/// The island as one graph: nodes at their poses in the map with ids + id_offset, the edges of all
/// missions, the island's positions, and the accepted loops. What a joint file cannot say becomes a comment that names the
/// mission: platform ids, own GNSS lines, unknown lines; FIX lines and priors of all missions but
/// the first, whose frame is the map frame; weights of loops that the last optimisation doubted.
/// Throws Error(data) when two missions share an id.
Mission fused_mission(const Atlas& atlas, const Island& island);

/// Stamped poses in the map frame, in order of the nodes. Nodes without a stamp have no row.
std::vector<StampedPose> trajectory(const MissionState& state);

/// The file name of an island's share of an output: "fused.g2o", "fused_island_1.g2o", ...
std::string island_file(const std::string& stem, std::size_t island, const std::string& extension);

}  // namespace cambium
