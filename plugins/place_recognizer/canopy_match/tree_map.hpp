// SPDX-License-Identifier: BSD-3-Clause
// The trees of a mission in its own frame, whoever saw them: as stems from the ground or as tops
// from above.
#pragma once
#include <vector>

#include "cambium/kinds.hpp"

namespace canopy_match {

struct TreeMap {
  std::vector<cambium::SE3> T_mission_node;
  std::vector<cambium::Vec3> trees;  ///< bases; z is that of the ground [m]
};

/// Detections nearer to each other than `radius` [m] are one tree, at the median height of their
/// bases; those with fewer than `min_sightings` are left out, unless the mission is shorter than
/// that. In an order that depends on the mission alone.
TreeMap map_trees(const cambium::MissionView& mission, double radius, int min_sightings,
                  const cambium::Context& context);

cambium::Fingerprints to_fingerprints(const TreeMap& map);
/// Throws Error(data) when the bytes are not from to_fingerprints().
TreeMap from_fingerprints(const cambium::Fingerprints& fingerprints);

}  // namespace canopy_match
