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

/// Turns the target's axes upright. Robots carry their base frames tilted by ten degrees and more;
/// stems say where up is: the geometric median of their axes (Weiszfeld, 1937).
cambium::Quat q_upright_target(const std::vector<cambium::Tree>& target,
                               const std::vector<cambium::Tree>& source,
                               const cambium::Quat& q_target_source);

/// The trees in other axes: bases and stem axes turned.
std::vector<cambium::Tree> turned(const cambium::Quat& q, std::vector<cambium::Tree> trees);

/// Each stem of the source with the nearest one of the target within `radius`, where that is mutual
/// and the diameters differ by at most `max_dbh_difference` [m]. Distances are horizontal (the
/// target's z axis is up): the bases lie on a ground that the detector believes in.
std::vector<Pair> mutual_pairs(const std::vector<cambium::Tree>& target,
                               const std::vector<cambium::Tree>& source,
                               const cambium::SE3& T_target_source, double radius,
                               double max_dbh_difference);

struct Noise {
  double stem = 0.08;  ///< of a stem's horizontal position [m]
  double base = 0.5;   ///< of the ground of a node, in which the bases of its stems err alike [m]
  double tilt = 0.01;  ///< of roll and pitch of the guess: gravity is known [rad]
};

/// How far the target lies above the source, as most matched bases say.
struct Heights {
  double offset = 0;            ///< to be added to the guess [m]
  std::vector<double> weights;  ///< of each pair, 0..1: does it agree with the offset
  double share = 0;             ///< of the pairs, those that agree to 0.2 m
};
/// The mode of the differences, by reweighted means whose width falls from metres to decimetres
/// (graduated non-convexity): a ground that is wrong under a part of the stems is left out.
Heights heights(const std::vector<cambium::Tree>& target, const std::vector<cambium::Tree>& source,
                const std::vector<Pair>& pairs, const cambium::SE3& T_target_source);

struct Fit {
  cambium::SE3 T_target_source;
  cambium::Mat6 normal_equations;  ///< of (translation; rotation), pose_graph.hpp's residual
  double rmse = 0;                 ///< horizontal, of the pairs [m]
};

/// One Gauss-Newton step from T_target_source with Cauchy weights on the horizontal residuals.
/// Heights count by `height_weights`, one a pair; all 0: the height stays that of the guess.
/// Without `correct_tilt`, roll and pitch stay those of the guess.
Fit step(const std::vector<cambium::Tree>& target, const std::vector<cambium::Tree>& source,
         const std::vector<Pair>& pairs, const std::vector<double>& height_weights,
         const cambium::SE3& T_target_source, const Noise& noise, bool correct_tilt);

}  // namespace tree_align
