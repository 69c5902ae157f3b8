// SPDX-License-Identifier: BSD-3-Clause
// map.json, which tells the page what there is. docs/view.md describes it.
#pragma once
#include <nlohmann/json.hpp>

#include "cambium/stems.hpp"
#include "tiles.hpp"

namespace web_view {

using Json = nlohmann::ordered_json;

/// Number of each mission's first node, counted over all missions.
std::vector<std::uint32_t> first_nodes(const cambium::Atlas& atlas);

Json missions_json(const cambium::Atlas& atlas);

/// The poses of all nodes at each stage of the fusion: first by the robots' odometry, each mission
/// placed where it begins in the map, then as each optimisation left them, last as in the map. x y z qx qy qz qw for each node.
Json stages_json(const cambium::Atlas& atlas);

/// Every loop that was ever proposed, one row each; texts are numbers of "strings".
Json loops_json(const cambium::Atlas& atlas);

Json stems_json(const std::vector<cambium::Stem>& stems, std::size_t island);
Json tiles_json(const TileTree& tree, const std::string& folder);

/// Rounded to `digits` behind the point; null for what is not finite.
Json rounded(double value, int digits);

}  // namespace web_view
