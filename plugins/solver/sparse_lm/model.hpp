// SPDX-License-Identifier: BSD-3-Clause
// The cost that is minimised, its unknowns, and its model around them. Under switchable constraints
// (N. Suenderhauf, P. Protzel, IROS 2012) each robust factor has a switch, an unknown like the
// poses. The normal equations have it eliminated, so it costs nothing there, and gets its step from
// that of the poses.
#pragma once
#include "common/normal_equations.hpp"

namespace cambium::sparse_lm {

struct State {
  std::vector<SE3> T_map_node;
  pose_solver::Weights switches;  ///< from 1, trusted, towards 0; unused by other losses
};

class Model {
 public:
  /// All of them must outlive it.
  Model(const PoseGraph& graph, pose_solver::NormalEquations& equations,
        const pose_solver::Weights& weights, const pose_solver::Loss& loss)
      : graph_(graph), equations_(equations), weights_(weights), loss_(loss) {}

  double cost(const State& state) const;
  void linearize(const State& state);
  /// After a step of the poses.
  State moved(const State& state, const Eigen::VectorXd& step) const;
  /// What the model loses when the poses stay and every switch takes its best value.
  double gain_of_switches(const State& state) const;

 private:
  double jacobian_times(const RelativeFactor& f, const State& state, const Vec6& r,
                        const Eigen::VectorXd& step) const;

  const PoseGraph& graph_;
  pose_solver::NormalEquations& equations_;
  const pose_solver::Weights& weights_;
  const pose_solver::Loss& loss_;
};

}  // namespace cambium::sparse_lm
