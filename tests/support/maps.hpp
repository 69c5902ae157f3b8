// SPDX-License-Identifier: BSD-3-Clause
// Maps that are bent on purpose, and what an evaluator says of them.
#pragma once
#include <map>
#include <string>

#include "support/support.hpp"

namespace cambium::testing {

/// All missions in one island, at the poses that they have.
Atlas tied(Atlas atlas);

/// The map with one mission moved as a whole: T_map_node becomes T * T_map_node.
Atlas moved(Atlas atlas, std::uint32_t mission, const SE3& T);

/// Where the truth of the tests lies: turned and shifted against the missions' own frames.
SE3 far_away();

/// Writes `<mission>.tum` for every mission: true are T_world_mission * its own poses.
void write_truth(const Atlas& atlas, const std::filesystem::path& folder,
                 const SE3& T_world_mission = far_away());

/// Metrics by name; fails the test when a name comes twice or does not begin with the plugin's.
std::map<std::string, double> evaluate(const std::string& plugin, const Atlas& atlas,
                                       const std::filesystem::path& reference = {},
                                       const std::string& yaml = "{}", int threads = 1);

}  // namespace cambium::testing
