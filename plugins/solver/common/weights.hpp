// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "cambium/pose_graph.hpp"

namespace cambium::pose_solver {

/// Factors of the information matrices, on top of the loss: 0 leaves a factor out.
struct Weights {
  std::vector<double> relative, positions;  ///< one a factor
};

inline Weights unit_weights(const PoseGraph& graph) {
  return {std::vector<double>(graph.relative.size(), 1.0),
          std::vector<double>(graph.positions.size(), 1.0)};
}

}  // namespace cambium::pose_solver
