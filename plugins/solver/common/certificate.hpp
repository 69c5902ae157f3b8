// SPDX-License-Identifier: BSD-3-Clause
// Whether a solution is the global optimum: D. Rosen, L. Carlone, A. Bandeira, J. Leonard,
// "SE-Sync: A certifiably correct algorithm for synchronization over the special Euclidean group",
// IJRR 38(2-3), 2019, theorem 3.
#pragma once
#include <string>

#include "common/weights.hpp"

namespace cambium::pose_solver {

struct Certificate {
  std::string not_applicable;  ///< why nothing can be said; else empty
  /// Of the dual certificate matrix S, over the largest diagonal entry of the data matrix, to 1 %.
  /// Not below -`certificate_tolerance`: no poses have a lower cost.
  double smallest_eigenvalue = 0;
  bool certified = false;
};

inline constexpr double certificate_tolerance = 1e-6;

/// With X = [R_1..R_n t_1..t_n] the cost is tr(X M X') when the information of every factor is one
/// number for rotation and one for translation. Where X is stationary, S = M - blkdiag(R_i' (X
/// M)_i) has X' in its null space, and X is a global minimum if S has no negative eigenvalue.
/// Other information matrices, attitude factors, priors and positions: not applicable.
Certificate certify(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
                    const std::vector<double>& weight);

}  // namespace cambium::pose_solver
