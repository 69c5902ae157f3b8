// SPDX-License-Identifier: BSD-3-Clause
// What the robot believes: lidar-inertial odometry drifts in yaw and scale, and sees gravity.
#pragma once
#include "simulate/trajectory.hpp"

namespace cambium::simulate {

/// T_mission_node of every node. The mission's frame has its origin and heading at the first node
/// and a vertical z axis. Yaw error and scale error are random walks along the path; roll and pitch
/// have an independent error at every node. `carried_at` > 0: the motion into that node was not
/// seen, the robot believes that it stood still.
std::vector<SE3> believed_poses(const std::vector<TruePose>& truth, const OdometrySpec& spec,
                                int carried_at, std::uint64_t seed);

/// Standard deviation after one metre of the two random walks [1, rad]: each alone gives
/// drift / sqrt(2) after drift_length.
double walk_rate(const OdometrySpec& spec);

}  // namespace cambium::simulate
