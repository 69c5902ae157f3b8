// SPDX-License-Identifier: BSD-3-Clause
// Trajectories of the KITTI odometry benchmark (Geiger, Lenz and Urtasun 2012).
#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "cambium/mission.hpp"

namespace trajectory {

struct KittiPose {
  std::optional<cambium::Stamp> stamp;
  cambium::SE3 T;
};

/// One pose a line: the 12 numbers of [R t], row by row. Stamps [s] are those of `times` (one a
/// line) when that is not empty. Throws Error(data, file:line) on another number of fields, numbers
/// that are none, a matrix that is no rotation (to 1e-3), or another number of stamps than of
/// poses.
std::vector<KittiPose> read_kitti(const std::filesystem::path& path,
                                  const std::filesystem::path& times);

/// The poses of a camera (x right, y down, z forward) as those of a base whose first pose has x
/// forward, y left, z up.
cambium::SE3 base_from_camera(const cambium::SE3& T_first_camera);

}  // namespace trajectory
