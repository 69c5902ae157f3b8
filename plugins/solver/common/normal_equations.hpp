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
  /// Which poses move, in an order that keeps the Cholesky factor of H sparse.
  NormalEquations(const PoseGraph& graph, const std::vector<bool>& held);

  /// H and g at these poses. A robust factor counts with its weight rho'(s).
  void linearize(const std::vector<SE3>& poses, const Weights& weights, const Loss& loss);
  std::vector<SE3> moved(const std::vector<SE3>& poses, const Eigen::VectorXd& step) const;

  const BlockMatrix& H() const { return H_; }
  const Eigen::VectorXd& g() const { return g_; }
  /// The row of blocks of a node; -1: it is held.
  int place(std::size_t node) const { return place_[node]; }

 private:
  void add_relative(const RelativeFactor& f, const BlockMatrix::Slot& slot, double weight,
                    const std::vector<SE3>& poses, const Loss& loss);
  void add_absolute(const std::vector<SE3>& poses, const Weights& weights, const Loss& loss);
  void add(int place, const Block& H, const Eigen::Matrix<double, 6, 1>& g);

  const PoseGraph& graph_;
  std::vector<int> place_;
  BlockMatrix H_;
  std::vector<BlockMatrix::Slot> slots_;  ///< of the relative factors whose poses both move
  Eigen::VectorXd g_;
};

}  // namespace cambium::pose_solver
