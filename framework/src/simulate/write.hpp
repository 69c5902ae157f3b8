// SPDX-License-Identifier: BSD-3-Clause
// Files of a simulation. Every file is whole or absent.
#pragma once
#include "simulate/camera.hpp"
#include "simulate/loops.hpp"

namespace cambium::simulate {

namespace fs = std::filesystem;

/// Pose graph, gnss.csv when there are fixes, ground_truth.tum (T_world_node, ENU).
void write_recording(const Recording& recording, const fs::path& folder);

/// A PNG file for every node, of what the camera saw.
void write_picture(const Picture& picture, const Stamp& stamp, const fs::path& mission_folder);

/// The true stem map in the world frame, with a column for each mission: 1 = it stood then.
void write_stems(const std::vector<Stem>& stems, const std::vector<Recording>& recordings,
                 const fs::path& path);

void write_loops(const std::vector<LoopPair>& loops, const std::vector<Recording>& recordings,
                 const fs::path& path);

}  // namespace cambium::simulate
