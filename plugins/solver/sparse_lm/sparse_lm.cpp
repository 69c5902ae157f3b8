// SPDX-License-Identifier: BSD-3-Clause
// Pose-graph optimisation of our own: see README.md.
#include "cambium/plugin.hpp"
#include "common/solve.hpp"
#include "levenberg_marquardt.hpp"

CAMBIUM_PLUGIN("sparse_lm", "0.1.0") {
  registry.add<cambium::pose_solver::SolverWith<cambium::sparse_lm::LevenbergMarquardt>>(
      "sparse_lm", "Levenberg-Marquardt made for pose graphs: block-sparse, supernodal Cholesky");
}
