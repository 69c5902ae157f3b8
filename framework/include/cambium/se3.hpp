// SPDX-License-Identifier: BSD-3-Clause
// Rigid transforms. T_target_source maps points: p_target = T_target_source * p_source.
#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cambium {

// DontAlign gives one memory layout for every compiler flag, so these types may cross the plugin
// boundary (a plugin built with -mavx2 would otherwise see other offsets than its host).
using Vec3 = Eigen::Matrix<double, 3, 1, Eigen::DontAlign>;
using Vec6 = Eigen::Matrix<double, 6, 1, Eigen::DontAlign>;
using Mat3 = Eigen::Matrix<double, 3, 3, Eigen::DontAlign>;
using Mat4 = Eigen::Matrix<double, 4, 4, Eigen::DontAlign>;
using Mat6 = Eigen::Matrix<double, 6, 6, Eigen::DontAlign>;
using Quat = Eigen::Quaternion<double, Eigen::DontAlign>;

/// A rigid transform: unit quaternion and translation [m].
/// Tangent vectors are (translation [m]; rotation vector [rad]), the order of the g2o dialect.
/// Formulas: Sola, Deray, Atchuthan, "A micro Lie theory", 2018, appendix D.
struct SE3 {
  Quat q = Quat::Identity();
  Vec3 t = Vec3::Zero();

  static SE3 exp(const Vec6& xi);            ///< exponential map
  Vec6 log() const;                          ///< inverse of exp, rotation angle in [0, pi]
  static SE3 from_matrix(const Mat4& T);     ///< nearest rotation is taken
  static SE3 from_yaw(double yaw, const Vec3& t = Vec3::Zero());  ///< rotation about z [rad]

  SE3 inverse() const;
  SE3 operator*(const SE3& other) const;  ///< the result is normalised again
  Vec3 operator*(const Vec3& point) const { return q * point + t; }
  Mat3 rotation() const { return q.toRotationMatrix(); }
  Mat4 matrix() const;
  Mat6 adjoint() const;  ///< T exp(xi) T^-1 = exp(adjoint xi)
  double yaw() const;    ///< heading of the x axis [rad], -pi..pi
  bool finite() const { return q.coeffs().allFinite() && t.allFinite(); }
};

double rotation_angle(const SE3& T);                       ///< [rad], 0..pi
SE3 interpolate(const SE3& a, const SE3& b, double s);     ///< on the geodesic, s = 0 gives a

}  // namespace cambium
