// SPDX-License-Identifier: BSD-3-Clause
// Which pairs of nodes saw the same part of the world.
#pragma once
#include "cambium/payload.hpp"
#include "simulate/recording.hpp"

namespace cambium::simulate {

/// The same keys for the same part of the world, ascending: occupied voxels, or stems.
using Footprint = std::vector<std::uint64_t>;

/// Voxels of 1 m in the world frame.
Footprint footprint(const Cloud& cloud, const SE3& T_world_base);

/// Share of the smaller one that the other one has too, 0..1; 0 when one is empty.
double overlap(const Footprint& a, const Footprint& b);

struct LoopPair {
  std::size_t tail_mission, tail, head_mission, head;
  double baseline;  ///< true distance [m]
  double overlap;   ///< 0..1
};

/// All pairs of nodes that meet the specification, ordered. `footprints` is [mission][node].
std::vector<LoopPair> true_loops(const std::vector<Recording>& recordings,
                                 const std::vector<std::vector<Footprint>>& footprints,
                                 const LoopsSpec& spec);

}  // namespace cambium::simulate
