// SPDX-License-Identifier: BSD-3-Clause
#include "edges.hpp"

namespace cambium::g2o_solver {

g2o::Isometry3 to_isometry(const SE3& T) {
  g2o::Isometry3 out = g2o::Isometry3::Identity();
  out.linear() = Eigen::Quaterniond(T.q).toRotationMatrix();
  out.translation() = T.t;
  return out;
}

SE3 from_isometry(const g2o::Isometry3& T) {
  return {Quat(Eigen::Quaterniond(T.linear())).normalized(), T.translation()};
}

Mat6 for_edge_se3(const Mat6& information, const SE3& T_tail_head) {
  Mat6 ours_of_g2o = 2 * Mat6::Identity();
  ours_of_g2o.topLeftCorner<3, 3>() = T_tail_head.rotation();
  return ours_of_g2o.transpose() * information * ours_of_g2o;
}

EdgeAttitude::EdgeAttitude(const AttitudeFactor& f)
    : P_(Eigen::Matrix3d::Identity() - f.up_node * f.up_node.transpose()) {
  setMeasurement(f.up_node);
  setInformation(Eigen::Matrix3d::Identity() / (f.sigma * f.sigma));
}

void EdgeAttitude::computeError() { _error = P_ * pose().linear().row(2).transpose(); }

void EdgeAttitude::linearizeOplus() {
  const Eigen::Vector3d up = pose().linear().row(2).transpose();
  Eigen::Matrix3d skew;
  skew << 0, -up.z(), up.y(), up.z(), 0, -up.x(), -up.y(), up.x(), 0;
  _jacobianOplusXi.leftCols<3>().setZero();
  _jacobianOplusXi.rightCols<3>() = 2 * P_ * skew;
}

EdgePosition::EdgePosition(const PositionFactor& f, double weight) {
  setMeasurement(f.t_map);
  setInformation(weight * f.information);
}

void EdgePosition::computeError() { _error = pose().translation() - _measurement; }

void EdgePosition::linearizeOplus() {
  _jacobianOplusXi.leftCols<3>() = pose().linear();
  _jacobianOplusXi.rightCols<3>().setZero();
}

}  // namespace cambium::g2o_solver
