// SPDX-License-Identifier: BSD-3-Clause
// What a robot brings home, besides its payloads.
#pragma once
#include "simulate/gnss.hpp"

namespace cambium::simulate {

struct Recording {
  MissionSpec spec;
  std::uint64_t seed = 0;       ///< of all that is random in this mission
  std::vector<Stem> stems;      ///< those that stood then
  std::vector<TruePose> truth;  ///< one per node
  Mission mission;              ///< poses and odometry edges as the robot believes them, fixes
};

/// Walks the path and writes the robot's diary. Throws Error(config) when the path leaves the area
/// or has fewer than two nodes.
Recording record(const SimulationSpec& spec, std::size_t mission, const Terrain& terrain,
                 const std::vector<Stem>& stems, const std::vector<Stem>& clutter);

}  // namespace cambium::simulate
