// SPDX-License-Identifier: BSD-3-Clause
// What both contexts give: a reference for a query, and where the query stands in it.
#pragma once
#include <vector>

#include "cambium/kinds.hpp"

namespace scan_context_pp {

struct Placement {
  std::size_t reference = 0;
  double score = 0.0;              ///< 1 the same, 0 at the threshold of the context that found it
  cambium::SE3 T_reference_query;  ///< both levelled
};

/// Those of one query, best first.
using Placements = std::vector<Placement>;

/// Two missions, and which pairs of them are wanted.
struct Missions {
  const cambium::Fingerprints& query;
  const cambium::Fingerprints& reference;
  const cambium::Pairing& pairing;
};

/// Where the part of one context begins in the rows and in the rest of the fingerprints.
struct Place {
  std::size_t column = 0, byte = 0;
};

}  // namespace scan_context_pp
