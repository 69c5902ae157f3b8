// SPDX-License-Identifier: BSD-3-Clause
// The Gauss-Newton model of the one cost: F(poses moved by d) = F + 2 g'd + d'Hd, where a pose
// moves by (dt in the map frame; dtheta in the node's), t <- t + dt, q <- q exp(dtheta).
#pragma once
#include "common/block_matrix.hpp"
#include "common/loss.hpp"
#include "common/weights.hpp"

namespace cambium::pose_solver {

class NormalEquations {
 public:
  /// Of the poses and factors of `elimination`; another factor must have the weight 0.
  NormalEquations(const PoseGraph& graph, const Elimination& elimination);

  /// H and g at these poses. A robust factor counts with its weight rho'(s); under a switchable
  /// loss its switch is eliminated: that of `switches`, or (null) the best one.
  void linearize(const std::vector<SE3>& poses, const Weights& weights, const Loss& loss,
                 const Weights* switches = nullptr);
  std::vector<SE3> moved(const std::vector<SE3>& poses, const Eigen::VectorXd& step) const;

  const Elimination& elimination() const { return elimination_; }
  const BlockMatrix<6>& H() const { return H_; }
  const Eigen::VectorXd& g() const { return g_; }

 private:
  void add_relative(std::size_t k, const std::vector<SE3>& poses, double weight, const Loss& loss,
                    const double* switch_of);
  void add_position(std::size_t k, const std::vector<SE3>& poses, double weight, const Loss& loss,
                    const double* switch_of);
  void add_absolute(const std::vector<SE3>& poses);
  void add(int place, const Block& H, const Eigen::Matrix<double, 6, 1>& g);

  const PoseGraph& graph_;
  const Elimination& elimination_;
  BlockMatrix<6> H_;
  std::vector<BlockMatrix<6>::Slot> slots_;  ///< of the relative factors whose poses both move
  Eigen::VectorXd g_;
};

}  // namespace cambium::pose_solver
