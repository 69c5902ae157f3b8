// SPDX-License-Identifier: BSD-3-Clause
// Yaw and translation between measured and mapped positions, and how well they are known.
#pragma once
#include <vector>

#include "common/fixes.hpp"

namespace similarity_4dof {

using cambium::gnss::Pair;

struct Fit {
  cambium::SE3 T_map_enu;
  double sigma_yaw = 0;       ///< [rad]; infinite when all places coincide
  double sigma_position = 0;  ///< of one horizontal axis, at the centre of the places [m]
  double rmse_horizontal = 0, max_horizontal = 0, rmse_vertical = 0;  ///< [m]
  double chi = 0;    ///< horizontal residuals over their stated sigma; about 1 when it is honest
  double reach = 0;  ///< root mean square distance of the places from their centre [m]
};

/// At least 2 pairs. Each is weighted by its mean horizontal variance; z is the median difference.
Fit fit(const std::vector<Pair>& pairs);

}  // namespace similarity_4dof
