// SPDX-License-Identifier: BSD-3-Clause
// The scans that trees are looked for in, in one levelled frame.
#pragma once
#include "cambium/atlas.hpp"
#include "views.hpp"

namespace stem_extraction {

struct Join {
  double radius = 0;     ///< along the path, of the nodes whose scans are joined [m]
  double spacing = 0.5;  ///< nodes nearer along the path to a joined one are left out [m]
  double range = 20;     ///< of the points that are kept, in x and y from the node [m]
};

struct Return {
  Eigen::Vector3f position;  ///< axes of the mission (z is up), origin at the node [m]
  std::uint16_t view;
};

struct Scans {
  std::vector<Return> points;
  std::vector<View> views;
  std::size_t own = 0;  ///< the view of the node itself
};

/// `cloud` is that of the node. Poses are those of the robot, not of the map.
Scans join(const cambium::MissionView& mission, std::size_t node, const cambium::Cloud& cloud,
           const Join& join);

}  // namespace stem_extraction
