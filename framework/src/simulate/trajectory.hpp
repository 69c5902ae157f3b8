// SPDX-License-Identifier: BSD-3-Clause
// Where the robot truly was.
#pragma once
#include <vector>

#include "cambium/mission.hpp"
#include "simulate/stand.hpp"

namespace cambium::simulate {

struct TruePose {
  SE3 T_world_base;
  double time = 0;  ///< since the first node [s]
};

/// The nodes of a mission's path. Roll and pitch sway; the path bends around stems and clutter that
/// stand in its way, since a robot cannot walk through them.
std::vector<TruePose> walk(const MissionSpec& mission, const Terrain& terrain,
                           const std::vector<Stem>& obstacles, std::uint64_t seed);

/// The corners of the path, in the world frame.
std::vector<Eigen::Vector2d> path_corners(const PathSpec& path);

}  // namespace cambium::simulate
