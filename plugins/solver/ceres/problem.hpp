// SPDX-License-Identifier: BSD-3-Clause
// A pose graph as a Ceres problem.
#pragma once
#include <ceres/problem.h>

#include <deque>
#include <vector>

#include "factors.hpp"
#include "loss.hpp"

namespace cambium::ceres_solver {

/// Owns what the problem points to. Deques, because cost functions cannot move.
class PoseProblem {
 public:
  PoseProblem(const PoseGraph& graph, const std::vector<SE3>& start, const std::vector<bool>& held,
              const Loss& loss);
  ceres::Problem& problem() { return problem_; }
  std::vector<SE3> poses() const;

 private:
  ceres::LossFunction* loss_for(bool robust) { return robust && loss_.robust() ? &loss_ : nullptr; }
  void add_relative(const PoseGraph& graph);
  void add_absolute(const PoseGraph& graph);

  Loss loss_;
  PoseManifold manifold_;
  PoseBlock origin_ = to_block(SE3{});  ///< the map frame, the tail of every prior
  std::vector<PoseBlock> blocks_;
  std::deque<RelativeCost> relative_;
  std::deque<AttitudeCost> attitude_;
  std::deque<PositionCost> positions_;
  ceres::Problem problem_;  ///< last: destroyed before what it points to
};

}  // namespace cambium::ceres_solver
