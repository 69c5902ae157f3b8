// SPDX-License-Identifier: BSD-3-Clause
// A pose graph as a Ceres problem.
#pragma once
#include <ceres/loss_function.h>
#include <ceres/problem.h>

#include <deque>
#include <memory>
#include <vector>

#include "common/loss.hpp"
#include "common/weights.hpp"
#include "factors.hpp"
#include "switchable.hpp"

namespace cambium::ceres_solver {

class CeresLoss final : public ceres::LossFunction {
 public:
  explicit CeresLoss(const pose_solver::Loss& loss) : loss_(loss) {}
  void Evaluate(double s, double rho[3]) const override { loss_.evaluate(s, rho); }

 private:
  pose_solver::Loss loss_;
};

/// Owns what the problem points to. Deques, because cost functions cannot move.
class PoseProblem {
 public:
  PoseProblem(const PoseGraph& graph, const std::vector<SE3>& start, const std::vector<bool>& held,
              const pose_solver::Weights& weights, const pose_solver::Loss& loss);
  ceres::Problem& problem() { return problem_; }
  std::vector<SE3> poses() const;

 private:
  /// A factor that the loss applies to when it is robust, or its switch.
  void add(const ceres::CostFunction& cost, bool robust, std::vector<double*> blocks);
  void add_relative(const PoseGraph& graph, const std::vector<bool>& held,
                    const std::vector<double>& weight);
  void add_absolute(const PoseGraph& graph, const std::vector<double>& position_weight);

  pose_solver::Loss kind_;
  std::unique_ptr<CeresLoss> loss_;  ///< none: all factors count by their squares
  PoseManifold manifold_;
  PoseBlock origin_ = to_block(SE3{});  ///< the map frame, the tail of every prior
  std::vector<PoseBlock> blocks_;
  std::deque<RelativeCost> relative_;
  std::deque<AttitudeCost> attitude_;
  std::deque<PositionCost> positions_;
  std::deque<SwitchableCost> switchable_;
  std::deque<double> switches_;
  ceres::Problem problem_;  ///< last: destroyed before what it points to
};

}  // namespace cambium::ceres_solver
