// SPDX-License-Identifier: BSD-3-Clause
// What a solver plugin brings; solve.hpp does the rest.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "cambium/context.hpp"
#include "common/loss.hpp"
#include "common/problem.hpp"
#include "common/weights.hpp"

namespace cambium::pose_solver {

struct Minimum {
  std::vector<SE3> T_map_node;
  int iterations = 0;
  bool converged = false;
  std::string message;  ///< why it stopped
  /// F of the factors that a pose moves, as the minimiser itself adds it up.
  double cost = 0;
};

/// When to stop.
struct Limits {
  int iterations = 100;
  double tolerance = 1e-9;  ///< of the cost, relative, by one step
};

/// Local minimisation over one graph, with as many weights and starts as are asked of it, so that
/// what follows from the structure is done once.
class Minimizer {
 public:
  virtual ~Minimizer() = default;
  virtual Minimum run(const std::vector<SE3>& start, const Weights& weights, const Loss& loss,
                      const Limits& limits, const Context& context) = 0;
};

using MakeMinimizer = std::function<std::unique_ptr<Minimizer>(const Problem&)>;

}  // namespace cambium::pose_solver
