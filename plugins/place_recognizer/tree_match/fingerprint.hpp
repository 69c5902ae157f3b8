// SPDX-License-Identifier: BSD-3-Clause
// What tree_match remembers of a mission, and how it becomes bytes.
#pragma once
#include <span>

#include "cambium/kinds.hpp"
#include "stem_map.hpp"
#include "triangles.hpp"

namespace tree_match {

struct Place {
  std::vector<cambium::SE3> T_mission_node;
  std::vector<double> path;          ///< distance travelled at each node [m]
  std::vector<Stem> stems;           ///< from the first node, along the mission's axes
  std::vector<Triangle> triangles;   ///< of the stems
  std::vector<Stem> detections;      ///< node by node, from their node, along the mission's axes
  std::vector<std::uint64_t> begin;  ///< of each node's detections, and their end

  std::span<const Stem> seen_from(std::size_t node) const {
    return std::span(detections).subspan(begin[node], begin[node + 1] - begin[node]);
  }
};

cambium::Fingerprints to_fingerprints(const Place& place);
/// Throws Error(data) when the bytes are not from to_fingerprints().
Place from_fingerprints(const cambium::Fingerprints& fingerprints);

}  // namespace tree_match
