// SPDX-License-Identifier: BSD-3-Clause
// The stems of a mission: the detections of all nodes, clustered in the mission's frame.
#pragma once
#include <cstdint>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"

namespace tree_match {

/// A stem, as the nodes first..last saw it. A stem that comes into view again later is another one:
/// the path has drifted in between, and within a mission the two must not be mixed.
struct Stem {
  float x = 0, y = 0, z = 0;          ///< base, mission's axes, from the first node [m]
  float dbh = 0;                      ///< [m]; 0 when it was never measured
  std::uint32_t first = 0, last = 0;  ///< nodes that saw it
  std::uint32_t sightings = 0;
};

struct MapLimits {
  double radius = 0.5;      ///< a detection belongs to a stem at most so far away [m]
  int min_sightings = 4;    ///< stems seen by fewer nodes are taken for false detections
  double revisit = 20.0;    ///< a stem not seen for so long along the path is closed [m]
  double max_track = 10.0;  ///< a stem in view for so long along the path is another one then [m]
  double max_clearance_change = 2.0;  ///< nodes whose ground is further off lose their heights [m]
  double max_range = 40.0;            ///< detections farther from their node are not used [m]
};

/// What a node saw: first = last = the node, one sighting each. A modelled stem weighs more.
struct Detection {
  Stem stem;  ///< from the node, along the mission's axes
  float weight = 0;
};
using Table = std::vector<Detection>;

/// One table a node, without detections that are not finite or too far away. A detector puts the
/// bases on the ground that it believes in, which on real tables lies metres off for minutes. Where
/// the ground around a node is not as far below it as usual in its mission, z is NaN.
std::vector<Table> tables(const cambium::MissionView& mission, const MapLimits& limits,
                          const cambium::Context& context);

/// In the order of first sightings. Gravity is taken from the poses: z is up in a mission's frame.
std::vector<Stem> stem_map(const cambium::Mission& mission, const std::vector<Table>& tables,
                           const MapLimits& limits, const cambium::Context& context);

}  // namespace tree_match
