// SPDX-License-Identifier: BSD-3-Clause
// The nodes that the robot passed shortly before and after a node.
#pragma once
#include <vector>

#include "cambium/mission.hpp"

namespace cambium::filter {

/// Indices of the nodes up to `radius` [m] from `node` along the path, ascending, without those
/// that lie nearer than `spacing` [m] along the path to one that is used. Chosen from the node
/// outwards; the node is always among them. The path is that of the robot's own poses.
std::vector<std::size_t> neighbours(const Mission& mission, std::size_t node, double radius,
                                    double spacing);

}  // namespace cambium::filter
