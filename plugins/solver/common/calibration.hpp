// SPDX-License-Identifier: BSD-3-Clause
// How uncertain odometry really is, by how well it agrees with the loops. Files often carry a
// placeholder, and the shape of a map between its loops depends on what is believed there.
#pragma once
#include <vector>

#include "common/loss.hpp"
#include "common/problem.hpp"
#include "common/weights.hpp"

namespace cambium::pose_solver {

/// Sigmas of now over those of the file.
struct SigmaScale {
  double factor = 1;
  bool known = false;  ///< enough loops say something about it
};

/// The odometry of one mission: what trusted factors tie together.
struct OdometryGroup {
  std::size_t first_node = 0;
  std::vector<std::size_t> factors;  ///< of PoseGraph::relative
  SigmaScale translation, rotation;
};

/// In the order of their first nodes.
std::vector<OdometryGroup> odometry_groups(const PoseGraph& graph);

/// One step of iterated variance component estimation (W. Foerstner, "Ein Verfahren zur Schaetzung
/// von Varianz- und Kovarianzkomponenten", AVN 86, 1979): scales the translation and the rotation
/// of each group's information such that its squared residuals become as large as their redundancy
/// at these poses. Returns the largest factor by which a sigma changed, 1 or above; 1 when nothing
/// could be estimated.
double calibrate(Problem& problem, const std::vector<SE3>& T_map_node, const Weights& weights,
                 const Loss& loss, std::vector<OdometryGroup>& groups);

}  // namespace cambium::pose_solver
