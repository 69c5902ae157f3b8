// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "cambium/se3.hpp"
#include "plan.hpp"

namespace cambium::registration {

struct Hypothesis {
  float score = 0;  ///< the correlation
  SE3 T_target_source;
};

/// The `count` best distinct placements of one plan on the other, best first: every heading, every
/// translation of the grid up to `max_distance` [m], the height from the grounds. Exhaustive.
std::vector<Hypothesis> correlate(const Plan& target, const Plan& source, const PlanGrid& grid,
                                  const Fft& fft, double max_distance, std::size_t count);

}  // namespace cambium::registration
