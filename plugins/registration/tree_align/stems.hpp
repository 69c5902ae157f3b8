// SPDX-License-Identifier: BSD-3-Clause
// Lays the stems of one node on those of another.
#pragma once
#include <vector>

#include "cambium/payload.hpp"

namespace tree_align {

struct Pair {
  std::size_t target, source;  ///< rows of the tables
};

/// The trees with finite bases and axes.
std::vector<cambium::Tree> usable(const std::vector<cambium::Tree>& trees);

/// Each stem of the source with the nearest one of the target within `radius`, where that is mutual
/// and the diameters differ by at most `max_dbh_difference` [m]. Distances are horizontal: the
/// bases lie on a ground that the detector believes in.
std::vector<Pair> mutual_pairs(const std::vector<cambium::Tree>& target,
                               const std::vector<cambium::Tree>& source,
                               const cambium::SE3& T_target_source, double radius,
                               double max_dbh_difference);

struct Noise {
  double stem = 0.08;  ///< of a stem's horizontal position [m]
  double base = 5.0;   ///< of a base's height; the stems of a node err alike [m]
  double tilt = 0.01;  ///< of roll and pitch of the guess: gravity is known [rad]
};

struct Fit {
  cambium::SE3 T_target_source;
  cambium::Mat6 normal_equations;  ///< of (translation; rotation), pose_graph.hpp's residual
  double rmse = 0;                 ///< horizontal, of the pairs [m]
};

/// One Gauss-Newton step from T_target_source with Cauchy weights on the horizontal residuals.
/// Without `correct_tilt`, roll and pitch stay those of the guess.
Fit step(const std::vector<cambium::Tree>& target, const std::vector<cambium::Tree>& source,
         const std::vector<Pair>& pairs, const cambium::SE3& T_target_source, const Noise& noise,
         bool correct_tilt);

}  // namespace tree_align
