// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/se3.hpp"

#include <cmath>
#include <limits>

namespace cambium {
namespace {

Mat3 skew(const Vec3& v) {
  Mat3 S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

// exp of a rotation vector; the series keeps full precision near zero.
Quat quat_exp(const Vec3& w) {
  const double theta2 = w.squaredNorm();
  const double theta = std::sqrt(theta2);
  const double k = theta < 1e-4 ? 0.5 - theta2 / 48.0 : std::sin(0.5 * theta) / theta;
  const Vec3 v = k * w;
  Quat q(std::cos(0.5 * theta), v.x(), v.y(), v.z());
  q.normalize();
  return q;
}

Vec3 quat_log(const Quat& q) {
  const double sign = q.w() < 0 ? -1.0 : 1.0;
  const double w = sign * q.w();
  const double n = q.vec().norm();
  if (n < 1e-9) return sign * q.vec() * (2.0 / w - (2.0 / 3.0) * n * n / (w * w * w));
  return sign * q.vec() * (2.0 * std::atan2(n, w) / n);
}

// Left Jacobian of SO(3), "V" of the cited appendix (eq. 174).
Mat3 left_jacobian(const Vec3& w) {
  const double theta2 = w.squaredNorm();
  const double theta = std::sqrt(theta2);
  const Mat3 W = skew(w);
  if (theta < 1e-3)
    return Mat3::Identity() + (0.5 - theta2 / 24.0) * W + (1.0 / 6.0 - theta2 / 120.0) * W * W;
  // (1 - cos theta) / theta^2, written so that small angles do not cancel.
  const double half = std::sin(0.5 * theta) / theta;
  return Mat3::Identity() + 2.0 * half * half * W +
         ((theta - std::sin(theta)) / (theta2 * theta)) * W * W;
}

Mat3 left_jacobian_inverse(const Vec3& w) {
  const double theta2 = w.squaredNorm();
  const double theta = std::sqrt(theta2);
  const Mat3 W = skew(w);
  const double k =
      theta < 1e-3 ? 1.0 / 12.0 + theta2 / 720.0
                   : 1.0 / theta2 - std::cos(0.5 * theta) / (2.0 * theta * std::sin(0.5 * theta));
  return Mat3::Identity() - 0.5 * W + k * W * W;
}

}  // namespace

SE3 SE3::exp(const Vec6& xi) {
  const Vec3 rho = xi.head<3>(), phi = xi.tail<3>();
  return {quat_exp(phi), left_jacobian(phi) * rho};
}

Vec6 SE3::log() const {
  const Vec3 phi = quat_log(q);
  Vec6 xi;
  xi << left_jacobian_inverse(phi) * t, phi;
  return xi;
}

SE3 SE3::from_matrix(const Mat4& T) {
  // The SVD of a matrix with NaN leaves its factors unset; the caller must see NaN instead.
  if (!T.allFinite()) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    return {Quat(nan, nan, nan, nan), Vec3::Constant(nan)};
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(T.topLeftCorner<3, 3>(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d R = svd.matrixU() * svd.matrixV().transpose();
  if (R.determinant() < 0) {
    Eigen::Matrix3d U = svd.matrixU();
    U.col(2) *= -1;
    R = U * svd.matrixV().transpose();
  }
  return {Quat(Mat3(R)), T.topRightCorner<3, 1>()};
}

SE3 SE3::from_yaw(double yaw, const Vec3& t) {
  return {Quat(std::cos(0.5 * yaw), 0, 0, std::sin(0.5 * yaw)), t};
}

SE3 SE3::inverse() const {
  const Quat inv = q.conjugate();
  return {inv, -(inv * t)};
}

SE3 SE3::operator*(const SE3& other) const {
  Quat product = q * other.q;
  product.normalize();
  return {product, q * other.t + t};
}

Mat4 SE3::matrix() const {
  Mat4 T = Mat4::Identity();
  T.topLeftCorner<3, 3>() = rotation();
  T.topRightCorner<3, 1>() = t;
  return T;
}

Mat6 SE3::adjoint() const {
  const Mat3 R = rotation();
  Mat6 A = Mat6::Zero();
  A.topLeftCorner<3, 3>() = R;
  A.bottomRightCorner<3, 3>() = R;
  A.topRightCorner<3, 3>() = skew(t) * R;
  return A;
}

double SE3::yaw() const {
  const Vec3 x = q * Vec3::UnitX();
  return std::atan2(x.y(), x.x());
}

double rotation_angle(const SE3& T) { return quat_log(T.q).norm(); }

SE3 interpolate(const SE3& a, const SE3& b, double s) {
  return a * SE3::exp(s * (a.inverse() * b).log());
}

}  // namespace cambium
