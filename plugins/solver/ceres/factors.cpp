// SPDX-License-Identifier: BSD-3-Clause
#include "factors.hpp"

#include "common/information.hpp"

namespace cambium::ceres_solver {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Vector = Eigen::Map<const Vector3d>;
using Quaternion = Eigen::Map<const Quaterniond>;
using VectorOut = Eigen::Map<Vector3d>;
template <int Rows>
using Jacobian = Eigen::Map<Eigen::Matrix<double, Rows, 7, Eigen::RowMajor>>;

Matrix3d skew(const Vector3d& v) {
  Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

}  // namespace

PoseBlock to_block(const SE3& T) {
  return {T.t.x(), T.t.y(), T.t.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w()};
}

SE3 from_block(const PoseBlock& b) {
  return {Quat(b[6], b[3], b[4], b[5]).normalized(), Vec3(b[0], b[1], b[2])};
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  Vec6 xi = Vec6::Zero();
  xi.tail<3>() = Vector(delta + 3);
  VectorOut{x_plus_delta} = Vector(x) + Vector(delta);
  Eigen::Map<Quaterniond> q(x_plus_delta + 3);
  q = Quaternion(x + 3) * Quaterniond(SE3::exp(xi).q);
  q.normalize();
  return true;
}

bool PoseManifold::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>>(jacobian).setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  const Quat dq = Quat(Quaternion(x + 3).conjugate() * Quaternion(y + 3)).normalized();
  VectorOut{y_minus_x} = Vector(y) - Vector(x);
  VectorOut{y_minus_x + 3} = SE3{dq, Vec3::Zero()}.log().tail<3>();
  return true;
}

bool PoseManifold::MinusJacobian(const double*, double* jacobian) const {
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>>(jacobian).setIdentity();
  return true;
}

RelativeCost::RelativeCost(const SE3& T_tail_head, const Mat6& information, double weight)
    : q_head_tail_(T_tail_head.q.conjugate()),
      R_head_tail_(q_head_tail_.toRotationMatrix()),
      t_tail_head_(T_tail_head.t) {
  pose_solver::square_root(weight * information, U_);
}

bool RelativeCost::Evaluate(double const* const* poses, double* residuals,
                            double** jacobians) const {
  const Quaterniond q_tail_map = Quaternion(poses[0] + 3).conjugate();
  const Matrix3d R_tail_map = q_tail_map.toRotationMatrix();
  const Vector3d t = R_tail_map * (Vector(poses[1]) - Vector(poses[0]));
  Quaterniond dq = q_head_tail_ * q_tail_map * Quaternion(poses[1] + 3);
  if (dq.w() < 0) dq.coeffs() *= -1;  // q and -q are one rotation
  Eigen::Matrix<double, 6, 1> r;
  r << t - t_tail_head_, 2 * dq.vec();
  Eigen::Map<Eigen::Matrix<double, 6, 1>>(residuals).noalias() = U_ * r;
  if (!jacobians) return true;

  // d(2 vec(dq exp(theta))) = (w I + [v]) theta, and the tail's turn enters through R_head_tail.
  const Matrix3d w = dq.w() * Matrix3d::Identity(), v = skew(dq.vec());
  const Eigen::Matrix<double, 6, 3> by_t = U_.leftCols<3>() * R_tail_map;
  if (jacobians[0]) {
    Jacobian<6> J(jacobians[0]);
    J.leftCols<3>() = -by_t;
    J.middleCols<3>(3) = U_.leftCols<3>() * skew(t) - U_.rightCols<3>() * ((w - v) * R_head_tail_);
    J.col(6).setZero();
  }
  if (jacobians[1]) {
    Jacobian<6> J(jacobians[1]);
    J.leftCols<3>() = by_t;
    J.middleCols<3>(3) = U_.rightCols<3>() * (w + v);
    J.col(6).setZero();
  }
  return true;
}

AttitudeCost::AttitudeCost(const AttitudeFactor& f)
    : P_((Matrix3d::Identity() - f.up_node * f.up_node.transpose()) / f.sigma) {}

bool AttitudeCost::Evaluate(double const* const* poses, double* residuals,
                            double** jacobians) const {
  const Vector3d up = Quaternion(poses[0] + 3).conjugate() * Vector3d::UnitZ();
  VectorOut{residuals} = P_ * up;
  if (!jacobians || !jacobians[0]) return true;
  Jacobian<3> J(jacobians[0]);
  J.setZero();
  J.middleCols<3>(3) = P_ * skew(up);
  return true;
}

PositionCost::PositionCost(const PositionFactor& f, double weight) : t_map_(f.t_map) {
  pose_solver::square_root(weight * f.information, U_);
}

bool PositionCost::Evaluate(double const* const* poses, double* residuals,
                            double** jacobians) const {
  VectorOut{residuals} = U_ * (Vector(poses[0]) - t_map_);
  if (!jacobians || !jacobians[0]) return true;
  Jacobian<3> J(jacobians[0]);
  J.setZero();
  J.leftCols<3>() = U_;
  return true;
}

}  // namespace cambium::ceres_solver
