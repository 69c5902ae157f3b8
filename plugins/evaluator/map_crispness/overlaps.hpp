// SPDX-License-Identifier: BSD-3-Clause
// Which scans are compared.
#pragma once
#include <utility>
#include <vector>

#include "cambium/context.hpp"
#include "cambium/truth.hpp"

namespace map_crispness {

using cambium::NodeRef;

struct Limits {
  double max_distance = 0;  ///< between the nodes [m]
  double min_path = 0;      ///< along the path, within a mission [m]
  std::size_t max_pairs = 0;
};

/// Pairs of nodes with payloads in one island that are close together: of two missions, or of two
/// passes of one. Close under the truth where it is known, so that a bent map is judged by the same
/// pairs as a good one. When there are more than max_pairs, they are thinned evenly.
std::vector<std::pair<NodeRef, NodeRef>> overlapping_pairs(const cambium::Atlas& atlas,
                                                           const cambium::Truth& truth,
                                                           const Limits& limits,
                                                           const cambium::Context& context);

}  // namespace map_crispness
