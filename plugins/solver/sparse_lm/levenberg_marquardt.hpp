// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt over sparse normal equations.
#pragma once
#include "common/minimizer.hpp"
#include "damped_system.hpp"

namespace cambium::sparse_lm {

class LevenbergMarquardt final : public pose_solver::Minimizer {
 public:
  /// Orders the unknowns and analyses the factorisation, once for all runs.
  LevenbergMarquardt(const PoseGraph& graph, const std::vector<bool>& held)
      : graph_(graph), equations_(graph, held), system_(equations_) {}

  pose_solver::Minimum run(const std::vector<SE3>& start, const pose_solver::Weights& weights,
                           const pose_solver::Loss& loss, const pose_solver::Limits& limits,
                           const Context& context) override;

 private:
  const PoseGraph& graph_;
  pose_solver::NormalEquations equations_;
  DampedSystem system_;
};

}  // namespace cambium::sparse_lm
