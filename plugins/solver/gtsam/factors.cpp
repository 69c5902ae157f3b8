// SPDX-License-Identifier: BSD-3-Clause
#include "factors.hpp"

#include <gtsam/linear/NoiseModel.h>
#include <gtsam/nonlinear/Values.h>

#include "common/information.hpp"

namespace cambium::gtsam_solver {
namespace {

using gtsam::Matrix3;
using gtsam::Vector3;

class LossFunction final : public gtsam::noiseModel::mEstimator::Base {
 public:
  explicit LossFunction(const pose_solver::Loss& loss) : loss_(loss) {}
  double loss(double distance) const override { return 0.5 * loss_.value(distance * distance); }
  double weight(double distance) const override { return loss_.weight(distance * distance); }
  void print(const std::string&) const override {}
  bool equals(const Base&, double) const override { return false; }

 private:
  pose_solver::Loss loss_;
};

gtsam::KeyVector variables(const End& tail, const End& head) {
  gtsam::KeyVector out;
  for (const End* end : {&tail, &head})
    if (!end->held) out.push_back(end->key);
  return out;
}

}  // namespace

gtsam::Pose3 to_gtsam(const SE3& T) {
  return {gtsam::Rot3(Eigen::Quaterniond(T.q)), gtsam::Point3(T.t)};
}

SE3 from_gtsam(const gtsam::Pose3& T) {
  return {Quat(T.rotation().toQuaternion()).normalized(), T.translation()};
}

Mat6 rotation_first(const Mat6& information) {
  Mat6 out;
  out << information.bottomRightCorner<3, 3>(), information.bottomLeftCorner<3, 3>(),
      information.topRightCorner<3, 3>(), information.topLeftCorner<3, 3>();
  return out;
}

gtsam::SharedNoiseModel noise(std::size_t rows, const pose_solver::Loss& loss) {
  const gtsam::SharedNoiseModel unit = gtsam::noiseModel::Unit::Create(rows);
  if (!loss.robust()) return unit;
  return gtsam::noiseModel::Robust::Create(std::make_shared<LossFunction>(loss), unit);
}

RelativeResidual::RelativeResidual(const End& tail, const End& head, const SE3& T_tail_head,
                                   const Mat6& information, double weight,
                                   const gtsam::SharedNoiseModel& noise)
    : NoiseModelFactor(noise, variables(tail, head)),
      tail_(tail),
      head_(head),
      T_tail_head_(to_gtsam(T_tail_head)) {
  pose_solver::square_root(weight * rotation_first(information), U_);
}

gtsam::Vector RelativeResidual::unwhitenedError(const gtsam::Values& poses,
                                                gtsam::OptionalMatrixVecType H) const {
  const gtsam::Pose3 tail = tail_.held ? *tail_.held : poses.at<gtsam::Pose3>(tail_.key);
  const gtsam::Pose3 head = head_.held ? *head_.held : poses.at<gtsam::Pose3>(head_.key);
  const Matrix3 R_tail_head = tail.rotation().matrix().transpose() * head.rotation().matrix();
  const Vector3 t =
      tail.rotation().matrix().transpose() * (head.translation() - tail.translation());
  const Matrix3 Rz = T_tail_head_.rotation().matrix();
  Eigen::Quaterniond dq(Matrix3(Rz.transpose() * R_tail_head));
  if (dq.w() < 0) dq.coeffs() *= -1;  // q and -q are one rotation
  gtsam::Vector6 r;
  r << 2 * dq.vec(), t - T_tail_head_.translation();
  if (H) {
    const Matrix3 w = dq.w() * Matrix3::Identity(), v = gtsam::skewSymmetric(dq.vec());
    std::size_t k = 0;
    gtsam::Matrix6 J = gtsam::Matrix6::Zero();
    if (!tail_.held) {
      J.topLeftCorner<3, 3>() = (v - w) * Rz.transpose();
      J.bottomLeftCorner<3, 3>() = gtsam::skewSymmetric(t);
      J.bottomRightCorner<3, 3>() = -Matrix3::Identity();
      (*H)[k++] = U_ * J;
    }
    if (!head_.held) {
      J.topLeftCorner<3, 3>() = w + v;
      J.bottomLeftCorner<3, 3>().setZero();
      J.bottomRightCorner<3, 3>() = R_tail_head;
      (*H)[k] = U_ * J;
    }
  }
  return U_ * r;
}

AttitudeResidual::AttitudeResidual(gtsam::Key node, const AttitudeFactor& f)
    : NoiseModelFactor(gtsam::noiseModel::Unit::Create(3), gtsam::KeyVector{node}),
      P_((Matrix3::Identity() - f.up_node * f.up_node.transpose()) / f.sigma) {}

gtsam::Vector AttitudeResidual::unwhitenedError(const gtsam::Values& poses,
                                                gtsam::OptionalMatrixVecType H) const {
  const auto& T = poses.at<gtsam::Pose3>(keys()[0]);
  const Vector3 up = T.rotation().matrix().row(2).transpose();
  if (H) {
    (*H)[0].setZero(3, 6);
    (*H)[0].leftCols<3>() = P_ * gtsam::skewSymmetric(up);
  }
  return P_ * up;
}

PositionResidual::PositionResidual(gtsam::Key node, const PositionFactor& f, double weight,
                                   const gtsam::SharedNoiseModel& noise)
    : NoiseModelFactor(noise, gtsam::KeyVector{node}), t_map_(f.t_map) {
  pose_solver::square_root(weight * f.information, U_);
}

gtsam::Vector PositionResidual::unwhitenedError(const gtsam::Values& poses,
                                                gtsam::OptionalMatrixVecType H) const {
  const auto& T = poses.at<gtsam::Pose3>(keys()[0]);
  if (H) {
    (*H)[0].setZero(3, 6);
    (*H)[0].rightCols<3>() = U_ * T.rotation().matrix();
  }
  return U_ * (T.translation() - t_map_);
}

}  // namespace cambium::gtsam_solver
