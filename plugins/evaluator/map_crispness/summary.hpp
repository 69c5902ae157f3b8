// SPDX-License-Identifier: BSD-3-Clause
// The figures of a map from those of its pairs of scans.
#pragma once
#include <optional>
#include <vector>

#include "agreement.hpp"
#include "cambium/kinds.hpp"

namespace map_crispness {

/// Two scans under the fused poses and, where they are known, under the true ones.
struct Compared {
  std::optional<Agreement> fused, truth;
};

/// Medians of distances and mean entropies, of the map and of the truth on the same pairs.
std::vector<cambium::Metric> summary(const std::vector<Compared>& compared);

}  // namespace map_crispness
