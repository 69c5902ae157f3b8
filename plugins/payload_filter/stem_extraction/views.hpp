// SPDX-License-Identifier: BSD-3-Clause
// Where several nodes saw the same stems, what they saw is moved until it agrees on the stems.
#pragma once
#include <vector>

#include "trees.hpp"

namespace stem_extraction {

/// Drift between the nodes of a submap smears stems by more than their surface is rough, and makes
/// them thicker. Finds the planar correction of each view that lays its points on the stems, and
/// the stems again, in turns; `own` is the view that stays. Then moves all points.
void align_views(std::vector<View>& views, std::size_t own, const FitLimits& limits,
                 std::vector<Found>& trees, std::vector<Above>& points);

}  // namespace stem_extraction
