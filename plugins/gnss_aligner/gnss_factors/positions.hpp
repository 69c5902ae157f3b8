// SPDX-License-Identifier: BSD-3-Clause
// Fixes along a path, as positions of its nodes.
#pragma once
#include "common/trajectory_fit.hpp"

namespace gnss_factors {

struct PositionSettings {
  double sigma_scale = 1, vertical_scale = 3;
  double correlation_time = 20, window = 120;  // [s]
  double outlier_width = 3;
};

/// One position per node that has a fix nearest to it in time. A node lies as far from its position
/// as the path lies, on average, from these fixes. Jumps are left out: fixes farther from the
/// running median of the distances between fixes and path than `outlier_width` sigmas. That median
/// bends with the map, so what the map has wrong stays. Covariances are those of the receiver,
/// enlarged where the fixes scatter more, where nodes are closer in time than twice the correlation
/// time (their errors are alike), and in height by `vertical_scale`.
std::vector<cambium::NodePosition> node_positions(const cambium::Atlas& atlas,
                                                  const cambium::gnss::Track& track,
                                                  const cambium::SE3& T_map_enu,
                                                  const PositionSettings& settings);

}  // namespace gnss_factors
