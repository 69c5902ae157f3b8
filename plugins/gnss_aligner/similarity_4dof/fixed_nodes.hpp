// SPDX-License-Identifier: BSD-3-Clause
// Nodes whose place on the globe a GNSS receiver measured.
#pragma once
#include <vector>

#include "cambium/geodesy.hpp"
#include "cambium/kinds.hpp"

namespace similarity_4dof {

/// A node, and the fixes around it interpolated to its time.
struct FixedNode {
  std::size_t node = 0;
  cambium::Geodetic place;
  cambium::Mat3 covariance;  ///< east, north, up [m^2]
  double path = 0;           ///< distance travelled up to the node [m]
};

/// All nodes between two fixes that are at most `max_gap` [s] apart, in order of time. A fix
/// is the nearest one of at most one node: nodes that share a measurement would count its noise
/// several times as if it were independent. Throws Error(data) on a fix that is not finite.
std::vector<FixedNode> fixed_nodes(const cambium::Mission& mission, double max_gap);

/// `count` of them: the first, or spread evenly over the distance travelled.
std::vector<FixedNode> choose(const std::vector<FixedNode>& nodes, std::size_t count, bool spread);

}  // namespace similarity_4dof
