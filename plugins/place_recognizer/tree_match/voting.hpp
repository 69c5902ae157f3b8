// SPDX-License-Identifier: BSD-3-Clause
// Every pair of similar triangles votes for where the query stands in the reference mission.
#pragma once
#include <vector>

#include "triangle_index.hpp"

namespace tree_match {

/// A planar motion: p_reference = R(yaw) p_query + (x, y).
struct Planar {
  double x = 0, y = 0, yaw = 0;
};

struct VoteLimits {
  double bin = 2.0;        ///< of x and y [m]
  double bin_yaw = 0.105;  ///< [rad]
  int bins = 30;           ///< the fullest ones become hypotheses
};

/// A hypothesis is the mean of the votes in a bin.
struct Peak {
  Planar T_reference_query;
  std::size_t votes = 0;
};

/// The fullest bins, most votes first. `end`: only stems last seen before this node count.
std::vector<Peak> vote(const std::vector<Triangle>& query, const TriangleIndex& reference,
                       std::uint32_t end, const VoteLimits& limits);

}  // namespace tree_match
