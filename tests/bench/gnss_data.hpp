// SPDX-License-Identifier: BSD-3-Clause
// The sets of the archive `gnss` as missions with one fix at every node's time.
#pragma once
#include <filesystem>

#include "cambium/mission.hpp"

namespace cambium::testing {

/// 2386 glim poses and RTK fixes at the same times.
Mission race_track(const std::filesystem::path& gnss);

/// 1208 KISS-ICP poses and 13 646 places without times or heights: each pose takes the
/// nearest place on the track around its share of the length, so that only the distance across the
/// track says something.
Mission munich(const std::filesystem::path& gnss);

/// The 664 nodes that have a GNSS prior, where the edges of the graph alone put them; the priors
/// are the fixes.
Mission hdl_from_edges(const std::filesystem::path& graph);

}  // namespace cambium::testing
