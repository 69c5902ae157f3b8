// SPDX-License-Identifier: BSD-3-Clause
// What is in a mission and what is wrong with it, as figures and findings.
#pragma once
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

struct PayloadFigures {
  std::size_t clouds = 0, empty_clouds = 0, tree_tables = 0, trees = 0, unreadable = 0;
  std::size_t points = 0, fewest_points = 0, most_points = 0;
  double median_points = 0;
  double farthest_point = 0;  ///< from the base frame [m]
  std::size_t bytes = 0;      ///< of all payloads in memory
};

struct Inspection {
  std::size_t nodes = 0, stamped = 0, fixed = 0;
  std::map<std::string, std::size_t> edges;          ///< by kind
  std::map<std::string, std::size_t> unknown_lines;  ///< by their first word
  std::optional<Stamp> first, last;
  double path_length = 0;                        ///< [m], along the nodes in order of their ids
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the positions [m]
  std::size_t parts = 0;                         ///< connected components over all edges
  /// How far odometry edges are from the poses they tie [m]: median and largest.
  double median_odometry_residual = 0, largest_odometry_residual = 0;
  PayloadFigures payloads;
  std::vector<std::string> findings;  ///< the reader's warnings, then what the checks found
};

using ParallelFor = std::function<void(std::size_t, const std::function<void(std::size_t)>&)>;

/// Loads every payload once.
Inspection inspect(const Mission& mission, const ParallelFor& parallel_for);

const char* to_string(EdgeKind kind);

}  // namespace cambium
