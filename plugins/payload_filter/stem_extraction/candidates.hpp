// SPDX-License-Identifier: BSD-3-Clause
// Where stems may stand, seen from above.
#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace stem_extraction {

/// What the points around a point say. Those of one ring of a sparse lidar say nothing.
enum class Surface : std::uint8_t { unknown, upright, other };

/// A point above the ground.
struct Above {
  Eigen::Vector3f position;            ///< gravity-levelled base frame [m]
  float height = 0;                    ///< above the ground [m]
  Surface surface = Surface::unknown;  ///< around it
  std::uint16_t view = 0;              ///< which of the joined nodes saw it
};

struct Candidate {
  float x = 0, y = 0;  ///< [m]
  int layers = 0;      ///< of a quarter of a metre that have points
  int upright = 0;     ///< of these, layers with upright points
  int known = 0;       ///< of these, layers with points whose surface is known
  int points = 0;
};

struct CandidateLimits {
  double layer_share = 0.5;  ///< of the layers between half a metre and four that must have points
  double min_upright = 0.2;  ///< share of the known layers that must have upright points
};

/// Within `range` of the origin in x and y [m]. Cells of 0.1 m around which (0.3 m) enough layers
/// have points, best first.
std::vector<Candidate> find_candidates(const std::vector<Above>& points, double range,
                                       const CandidateLimits& limits);

}  // namespace stem_extraction
