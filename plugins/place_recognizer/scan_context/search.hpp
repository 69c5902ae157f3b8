// SPDX-License-Identifier: BSD-3-Clause
// The best references of every query, over all pairs and all column shifts.
#pragma once
#include <vector>

#include "correlation.hpp"

namespace scan_context {

struct Limits {
  int candidates = 10;        ///< at most so many references for a query
  double threshold = 0.4;     ///< largest distance
  double min_overlap = 0.25;  ///< share of the sectors that must be filled in both
};

/// A pair at its best shift.
struct Match {
  std::size_t reference = 0;
  std::size_t view = 0;   ///< the query's viewpoint
  double distance = 1.0;  ///< equation (6) of the paper, minimised over the shifts: 0..1
  double yaw = 0.0;       ///< of the query seen in the reference, both levelled [rad]
};

/// For each query its matches, best first; of two equal ones the lower reference comes first.
/// `views` are the queries, described from one viewpoint after the other.
std::vector<std::vector<Match>> search(const std::vector<Spectra>& views, const Spectra& reference,
                                       const cambium::Pairing& pairing, const Limits& limits,
                                       const cambium::Context& context);

}  // namespace scan_context
