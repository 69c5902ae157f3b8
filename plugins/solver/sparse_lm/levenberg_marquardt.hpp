// SPDX-License-Identifier: BSD-3-Clause
// Levenberg-Marquardt over sparse normal equations.
#pragma once
#include <memory>

#include "common/minimizer.hpp"
#include "damped_system.hpp"

namespace cambium::sparse_lm {

class LevenbergMarquardt final : public pose_solver::Minimizer {
 public:
  explicit LevenbergMarquardt(const pose_solver::Problem& problem) : problem_(problem) {}

  pose_solver::Minimum run(const std::vector<SE3>& start, const pose_solver::Weights& weights,
                           const pose_solver::Loss& loss, const pose_solver::Limits& limits,
                           const Context& context) override;

 private:
  /// What follows from which factors there are, kept over many runs.
  struct Structure {
    Structure(const pose_solver::Problem& problem, std::vector<bool> use);
    std::vector<bool> use;  ///< relative factors; the others must have the weight 0
    std::unique_ptr<const pose_solver::Elimination> own;  ///< of those; null when all are used
    pose_solver::NormalEquations equations;
    DampedSystem system;
  };
  Structure& structure_for(const pose_solver::Weights& weights);

  const pose_solver::Problem& problem_;
  std::unique_ptr<Structure> structure_;
};

}  // namespace cambium::sparse_lm
