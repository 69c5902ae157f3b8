// SPDX-License-Identifier: BSD-3-Clause
// The laws of the group SE(3), in the way that manif tests its groups: on seeded random elements,
// on rotations near zero and near pi, and with both signs of the quaternion.
#include <cmath>
#include <numbers>
#include <random>

#include "cambium/se3.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

constexpr double precision = 1e-12;
constexpr double pi = std::numbers::pi;

class Random {
 public:
  double normal() { return normal_(engine_); }
  Vec3 direction() { return Vec3(normal(), normal(), normal()).normalized(); }
  /// A tangent vector with a rotation of this angle [rad].
  Vec6 tangent(double angle) {
    Vec6 xi;
    xi << 3 * normal(), 3 * normal(), 3 * normal(), angle * direction();
    return xi;
  }

 private:
  std::mt19937_64 engine_{7};
  std::normal_distribution<double> normal_;
};

/// The largest difference between two transforms, free of the quaternion's sign.
double difference(const SE3& a, const SE3& b) {
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff();
}

const double angles[] = {0,      1e-300,  1e-17,  1e-12,     1e-9,     1e-8, 1e-6,
                         9.9e-5, 1.01e-4, 9.9e-4, 1.01e-3,   1e-2,     0.1,  1.0,
                         2.0,    3.0,     3.14,   pi - 1e-6, pi - 1e-9};

std::vector<SE3> elements() {
  Random random;
  std::vector<SE3> out{SE3{}};
  for (const double angle : angles)
    for (int k = 0; k < 5; ++k) out.push_back(SE3::exp(random.tangent(angle)));
  out.push_back({Quat(0, 1, 0, 0), Vec3(1, 2, 3)});  // exactly pi
  const std::size_t n = out.size();
  for (std::size_t i = 0; i < n; ++i)
    out.push_back({Quat(-out[i].q.w(), -out[i].q.x(), -out[i].q.y(), -out[i].q.z()), out[i].t});
  return out;
}

TEST(SE3, IdentityAndInverse) {
  for (const SE3& T : elements()) {
    EXPECT_EQ(difference(SE3{} * T, T * SE3{}), 0);
    EXPECT_LT(difference(T * SE3{}, T), precision);
    EXPECT_LT(difference(T * T.inverse(), SE3{}), precision);
    EXPECT_LT(difference(T.inverse() * T, SE3{}), precision);
    EXPECT_LT(difference(T.inverse().inverse(), T), precision);
  }
}

TEST(SE3, IsAssociative) {
  const auto all = elements();
  for (std::size_t i = 0; i + 2 < all.size(); ++i)
    EXPECT_LT(difference((all[i] * all[i + 1]) * all[i + 2], all[i] * (all[i + 1] * all[i + 2])),
              precision);
}

TEST(SE3, InverseOfAProduct) {
  const auto all = elements();
  for (std::size_t i = 0; i + 1 < all.size(); ++i)
    EXPECT_LT(difference((all[i] * all[i + 1]).inverse(), all[i + 1].inverse() * all[i].inverse()),
              precision);
}

TEST(SE3, ProductStaysOfNormOne) {
  const auto all = elements();
  SE3 T;
  for (int k = 0; k < 10000; ++k) T = T * all[std::size_t(k) % all.size()];
  EXPECT_NEAR(T.q.norm(), 1, 1e-15);
}

TEST(SE3, ActsOnPointsLikeItsMatrix) {
  Random random;
  const auto all = elements();
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const Vec3 p = 10 * random.direction();
    const Eigen::Vector4d by_matrix = all[i].matrix() * p.homogeneous();
    EXPECT_LT((all[i] * p - by_matrix.head<3>()).norm(), precision);
    EXPECT_LT(((all[i] * all[i + 1]) * p - all[i] * (all[i + 1] * p)).norm(), precision);
  }
}

TEST(SE3, LogIsTheInverseOfExp) {
  Random random;
  for (const double angle : angles)
    for (int k = 0; k < 20; ++k) {
      const Vec6 xi = random.tangent(angle);
      EXPECT_LT((SE3::exp(xi).log() - xi).norm(), 10 * precision) << "angle " << angle;
    }
}

TEST(SE3, ExpIsTheInverseOfLog) {
  for (const SE3& T : elements()) {
    EXPECT_LT(difference(SE3::exp(T.log()), T), precision);
    EXPECT_LE(T.log().tail<3>().norm(), pi + 1e-15);
    EXPECT_NEAR(rotation_angle(T), T.log().tail<3>().norm(), 1e-15);
  }
}

TEST(SE3, BothSignsOfTheQuaternionAreOneRotation) {
  for (const SE3& T : elements()) {
    if (std::abs(T.q.w()) < 1e-12) continue;  // at pi the axis may point either way
    const SE3 negated{Quat(-T.q.w(), -T.q.x(), -T.q.y(), -T.q.z()), T.t};
    EXPECT_EQ((T.log() - negated.log()).norm(), 0);
    EXPECT_EQ(difference(T, negated), 0);
  }
}

TEST(SE3, ExpAddsOnOneAxis) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const Vec6 xi = random.tangent(1.0);
    EXPECT_LT(
        difference(SE3::exp(Vec6(0.3 * xi)) * SE3::exp(Vec6(0.5 * xi)), SE3::exp(Vec6(0.8 * xi))),
        precision);
  }
}

TEST(SE3, AdjointMovesTangentsThroughATransform) {
  Random random;
  const auto all = elements();
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const SE3& T = all[i];
    const Vec6 xi = random.tangent(0.7);
    EXPECT_LT(difference(T * SE3::exp(xi) * T.inverse(), SE3::exp(T.adjoint() * xi)),
              10 * precision);
    const Mat6 product = T.adjoint() * all[i + 1].adjoint();
    EXPECT_LT(((T * all[i + 1]).adjoint() - product).cwiseAbs().maxCoeff(), 10 * precision);
  }
}

TEST(SE3, InterpolationHitsItsEndsAndIsEven) {
  const auto all = elements();
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const SE3 &a = all[i], &b = all[i + 1];
    EXPECT_LT(difference(interpolate(a, b, 0), a), precision);
    EXPECT_LT(difference(interpolate(a, b, 1), b), 10 * precision);
    const SE3 step = a.inverse() * interpolate(a, b, 0.25);
    if (rotation_angle(a.inverse() * b) < 3.1) {
      EXPECT_LT(difference(a * step * step * step * step, b), 100 * precision);
    }
  }
}

TEST(SE3, FromMatrixInvertsMatrix) {
  for (const SE3& T : elements()) EXPECT_LT(difference(SE3::from_matrix(T.matrix()), T), precision);
}

TEST(SE3, FromMatrixTakesTheNearestRotation) {
  Random random;
  for (int k = 0; k < 20; ++k) {
    const SE3 T = SE3::exp(random.tangent(1.5));
    Mat4 scaled = T.matrix();
    scaled.topLeftCorner<3, 3>() *= 1.7;  // the nearest rotation does not change with the scale
    EXPECT_LT(difference(SE3::from_matrix(scaled), T), precision);
    Mat4 mirrored = T.matrix();
    mirrored.col(2).head<3>() *= -1;
    EXPECT_NEAR(SE3::from_matrix(mirrored).rotation().determinant(), 1, precision);
  }
}

TEST(SE3, FromMatrixKeepsNaN) {
  Mat4 T = Mat4::Identity();
  T(1, 2) = std::nan("");
  EXPECT_FALSE(SE3::from_matrix(T).finite());
}

TEST(SE3, YawIsTheHeading) {
  for (const double yaw : {-3.0, -1.0, 0.0, 1e-9, 0.5, 3.1}) {
    const SE3 T = SE3::from_yaw(yaw, Vec3(1, 2, 3));
    EXPECT_NEAR(T.yaw(), yaw, 1e-15);
    EXPECT_EQ(T.t, Vec3(1, 2, 3));
    EXPECT_LT((T.q * Vec3::UnitX() - Vec3(std::cos(yaw), std::sin(yaw), 0)).norm(), precision);
  }
}

}  // namespace
}  // namespace cambium
