// SPDX-License-Identifier: BSD-3-Clause
// The factors of cambium/pose_graph.hpp with analytic Jacobians. A pose is one block of 7 numbers,
// (t; q = x y z w), moved by 6: t <- t + dt in the map frame, q <- q exp(dtheta) in the node's.
#pragma once
#include <ceres/manifold.h>
#include <ceres/sized_cost_function.h>

#include <array>

#include "cambium/pose_graph.hpp"

namespace cambium::ceres_solver {

using PoseBlock = std::array<double, 7>;
PoseBlock to_block(const SE3& T);
SE3 from_block(const PoseBlock& block);

/// Its Jacobian is [I; 0]: the cost functions write derivatives by the 6 tangent directions into
/// the first 6 of their 7 columns, which saves the detour through the quaternion's components.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

/// U residual(T_tail_head, tail, head), U' U = weight * information. A prior is one whose tail is
/// the map.
class RelativeCost final : public ceres::SizedCostFunction<6, 7, 7> {
 public:
  RelativeCost(const SE3& T_tail_head, const Mat6& information, double weight);
  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override;

 private:
  Eigen::Matrix<double, 6, 6> U_;
  Eigen::Quaterniond q_head_tail_;
  Eigen::Matrix3d R_head_tail_;
  Eigen::Vector3d t_tail_head_;
};

class AttitudeCost final : public ceres::SizedCostFunction<3, 7> {
 public:
  explicit AttitudeCost(const AttitudeFactor& factor);
  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override;

 private:
  Eigen::Matrix3d P_;  ///< projects on the plane normal to up_node, over sigma
};

class PositionCost final : public ceres::SizedCostFunction<3, 7> {
 public:
  PositionCost(const PositionFactor& factor, double weight);
  bool Evaluate(double const* const* poses, double* residuals, double** jacobians) const override;

 private:
  Eigen::Matrix3d U_;
  Eigen::Vector3d t_map_;
};

}  // namespace cambium::ceres_solver
