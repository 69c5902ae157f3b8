// SPDX-License-Identifier: BSD-3-Clause
// A map taken apart again, and poses between its nodes.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/files.hpp"

namespace cambium {

/// The mission with its own ids, edges and lines, and its poses where the map has them. Its frame
/// is then that of the map of its island, so priors move along and the georeference is the
/// island's.
Mission updated_mission(const Atlas& atlas, std::uint32_t mission);

/// Stamps from a table: the first column, or two columns `sec,nsec`. One number is seconds, or
/// nanoseconds when it is a whole number too large to be seconds (EuRoC's data.csv). Further
/// columns and lines that begin with # or a letter are not looked at. Throws Error(data,
/// file:line).
std::vector<Stamp> parse_stamps(std::string_view text, const std::filesystem::path& where);

/// Where a mission was at any time.
class Interpolator {
 public:
  /// `odometry`: T_odom_base of the same robot, denser than the nodes; may be empty. Nodes without
  /// a stamp do not count.
  Interpolator(const MissionState& state, std::vector<StampedPose> odometry);

  /// Between two nodes: where odometry covers both and `stamp`, it is followed from the first node,
  /// and what is missing at the second is spread over the way by its share of the time; else the
  /// geodesic of SE3. Nothing before the first and behind the last node.
  std::optional<SE3> T_map_base(const Stamp& stamp) const;

 private:
  std::vector<StampedPose> path_, odometry_;  // in order of time
};

}  // namespace cambium
