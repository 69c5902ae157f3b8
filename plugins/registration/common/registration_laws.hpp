// SPDX-License-Identifier: BSD-3-Clause
// What every registration must keep, whatever its method. A plugin's test names itself:
//   INSTANTIATE_TEST_SUITE_P(Gicp, RegistrationLaws, ::testing::Values(Method{"gicp", 0.01,
//   0.001}));
#pragma once
#include <Eigen/Eigenvalues>
#include <cstring>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include "support/support.hpp"

namespace cambium::testing {

struct Method {
  std::string plugin;
  double translation;  ///< accuracy on a cloud and its moved copy [m]
  double rotation;     ///< [rad]
  friend std::ostream& operator<<(std::ostream& out, const Method& m) { return out << m.plugin; }
};

class RegistrationLaws : public ::testing::TestWithParam<Method> {
 protected:
  std::shared_ptr<const Registration> make(const std::string& yaml = "{}") const {
    return component<Registration>(GetParam().plugin, yaml);
  }
  static Prepared prepare(const Registration& method, Cloud cloud) {
    return method.prepare({std::make_shared<const Cloud>(std::move(cloud)), nullptr},
                          *make_context());
  }
  static Alignment align(const Registration& method, const Cloud& target, const Cloud& source,
                         const SE3& guess) {
    return method.align(prepare(method, target), prepare(method, source), guess, *make_context());
  }
};

inline SE3 motion(double x, double y, double z, double roll, double pitch, double yaw) {
  Vec6 xi;
  xi << x, y, z, roll, pitch, yaw;
  return SE3::exp(xi);
}

inline void expect_near(const SE3& a, const SE3& b, double translation, double rotation) {
  const SE3 d = a.inverse() * b;
  EXPECT_LT(d.t.norm(), translation)
      << "found " << a.t.transpose() << ", expected " << b.t.transpose();
  EXPECT_LT(rotation_angle(d), rotation);
}

/// A rectangle of points [m]: `origin` + u a + v b, u and v in steps of 0.1 m.
inline void add_wall(Cloud& cloud, const Vec3& origin, const Vec3& a, const Vec3& b) {
  const int n = int(a.norm() / 0.1), m = int(b.norm() / 0.1);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const Vec3 p = origin + a * (double(i) / n) + b * (double(j) / m);
      for (int k = 0; k < 3; ++k) cloud.xyz.push_back(float(p[k]));
    }
}

inline Cloud corridor() {
  Cloud cloud;
  add_wall(cloud, {-15, -2, -1}, {30, 0, 0}, {0, 4, 0});
  add_wall(cloud, {-15, -2, -1}, {30, 0, 0}, {0, 0, 3});
  add_wall(cloud, {-15, 2, -1}, {30, 0, 0}, {0, 0, 3});
  return cloud;
}

inline Vec6 sigmas(const Mat6& information) {
  return Eigen::Matrix<double, 6, 6>(information).inverse().diagonal().cwiseSqrt();
}

inline bool same_bytes(const Alignment& a, const Alignment& b) {
  const auto equal = [](const auto& x, const auto& y) {
    return std::memcmp(x.data(), y.data(), sizeof(double) * std::size_t(x.size())) == 0;
  };
  return a.converged == b.converged && a.reason == b.reason && a.scores == b.scores &&
         equal(a.information, b.information) && equal(a.T_target_source.t, b.T_target_source.t) &&
         equal(a.T_target_source.q.coeffs(), b.T_target_source.q.coeffs());
}

TEST_P(RegistrationLaws, RecoversTheMotionOfAMovedCopy) {
  const auto method = make();
  const Cloud cloud = forest_scan(SE3{});
  const SE3 T = motion(1.2, -0.8, 0.1, 0.02, -0.03, 0.4);
  const Alignment a =
      align(*method, transformed(T, cloud), cloud, T * motion(0.3, -0.2, 0.1, 0.01, 0.02, -0.03));
  EXPECT_TRUE(a.converged) << a.reason;
  expect_near(a.T_target_source, T, GetParam().translation, GetParam().rotation);
}

TEST_P(RegistrationLaws, FindsTheOffsetFromAYawAlone) {
  const auto method = make();
  const SE3 T_world_a = motion(0, 0, 1, 0, 0, 0.3), T_world_b = motion(5, 4, 1.2, 0.02, 0.03, 1.0);
  const SE3 truth = T_world_a.inverse() * T_world_b;
  const Alignment a = align(*method, forest_scan(T_world_a), forest_scan(T_world_b),
                            SE3::from_yaw(truth.yaw() + 0.05));
  EXPECT_TRUE(a.converged) << a.reason;
  expect_near(a.T_target_source, truth, 0.15, 0.02);
}

TEST_P(RegistrationLaws, SwappedRolesGiveTheInverse) {
  const auto method = make();
  const SE3 T_world_a, T_world_b = motion(2, 1, 0.1, 0.02, 0, 0.5);
  const Cloud a = forest_scan(T_world_a), b = forest_scan(T_world_b);
  const SE3 guess = T_world_b * motion(0.2, -0.3, 0, 0, 0, 0.03);
  const SE3 T_a_b = align(*method, a, b, guess).T_target_source;
  const SE3 T_b_a = align(*method, b, a, guess.inverse()).T_target_source;
  expect_near(T_b_a, T_a_b.inverse(), 0.1, 0.01);
}

TEST_P(RegistrationLaws, AnotherPlaceDoesNotConverge) {
  const auto method = make();
  const Alignment a = align(*method, forest_scan(SE3{}, 1), forest_scan(SE3{}, 2), SE3{});
  EXPECT_FALSE(a.converged);
  EXPECT_NE(a.reason, "");
}

TEST_P(RegistrationLaws, BadCloudsAreNoConvergenceAndSayWhy) {
  const auto method = make();
  const auto context = make_context();
  const Prepared good = prepare(*method, forest_scan(SE3{}, 1, 8000));
  Cloud three, not_a_number, one_place;
  three.xyz = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  not_a_number.xyz.assign(3000, std::numeric_limits<float>::quiet_NaN());
  one_place.xyz.assign(3000, 1.0F);
  const Cloud far_away = transformed(SE3{Quat::Identity(), Vec3(5e4, 0, 0)}, corridor());
  for (const Cloud& bad : {Cloud{}, three, not_a_number, one_place, far_away}) {
    const Prepared p = prepare(*method, bad);
    for (const Alignment& a :
         {method->align(good, p, SE3{}, *context), method->align(p, good, SE3{}, *context)}) {
      EXPECT_FALSE(a.converged);
      EXPECT_NE(a.reason, "");
      EXPECT_TRUE(a.T_target_source.finite());
    }
  }
}

TEST_P(RegistrationLaws, ANodeWithoutACloudIsNoConvergence) {
  const auto method = make();
  const auto context = make_context();
  const Prepared none = method->prepare({}, *context), good = prepare(*method, corridor());
  EXPECT_NE(method->align(none, good, SE3{}, *context).reason.find("target"), std::string::npos);
  EXPECT_NE(method->align(good, none, SE3{}, *context).reason.find("source"), std::string::npos);
}

TEST_P(RegistrationLaws, AGuessThatIsNotFiniteIsNoConvergence) {
  const auto method = make();
  SE3 guess;
  guess.t.x() = std::numeric_limits<double>::quiet_NaN();
  const Alignment a = align(*method, corridor(), corridor(), guess);
  EXPECT_FALSE(a.converged);
  EXPECT_NE(a.reason.find("guess"), std::string::npos);
}

TEST_P(RegistrationLaws, PointsThatAreNotFiniteChangeNothing) {
  const auto method = make();
  const Cloud clean = forest_scan(SE3{}, 1, 8000);
  Cloud dirty = clean;
  for (const float bad :
       {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    dirty.xyz.insert(dirty.xyz.end(), {bad, 0.0F, 0.0F});
  const SE3 guess = motion(0.2, 0.1, 0, 0, 0, 0.05);
  EXPECT_TRUE(same_bytes(align(*method, clean, clean, guess), align(*method, dirty, dirty, guess)));
}

TEST_P(RegistrationLaws, TheSameBytesTwiceAndFromTwoThreads) {
  const auto method = make();
  const Prepared a = prepare(*method, forest_scan(SE3{}, 1, 8000)),
                 b = prepare(*method, forest_scan(motion(1, 0, 0, 0, 0, 0.2), 1, 8000));
  const auto context = make_context();
  const auto run = [&] { return method->align(a, b, motion(0.5, 0, 0, 0, 0, 0.1), *context); };
  const Alignment once = run();
  std::vector<Alignment> results(2);
  std::thread other([&] { results[0] = run(); });
  results[1] = run();
  other.join();
  for (const Alignment& r : results) EXPECT_TRUE(same_bytes(r, once));
}

TEST_P(RegistrationLaws, InformationIsPositiveDefiniteAndNotBelowTheFloor) {
  const auto method = make("{sigma_translation_floor: 0.04, sigma_rotation_floor: 0.01}");
  const Cloud cloud = forest_scan(SE3{});
  const Mat6 information = align(*method, cloud, cloud, SE3{}).information;
  EXPECT_EQ(information, Mat6(information.transpose()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(information);
  EXPECT_GT(eigen.eigenvalues().minCoeff(), 0);
  const Vec6 sigma = sigmas(information);
  EXPECT_GE(sigma.head<3>().minCoeff(), 0.04 * (1 - 1e-9));
  EXPECT_GE(sigma.tail<3>().minCoeff(), 0.01 * (1 - 1e-9));
  EXPECT_LT(sigma.head<3>().maxCoeff(), 0.08) << "a forest holds every direction";
}

TEST_P(RegistrationLaws, ACorridorIsWeakAlongItself) {
  const auto method = make("{search_radius: 0, search_yaw: 0}");
  const Alignment a = align(*method, corridor(), corridor(), motion(0, 0.2, 0.1, 0, 0, 0.02));
  EXPECT_TRUE(a.converged) << a.reason;
  const Vec6 sigma = sigmas(a.information);
  // Normals along the edges of walls and floor lean a little, so the ends are not quite unheld.
  EXPECT_GT(sigma[0], 3 * sigma[1]);
  EXPECT_GT(sigma[0], 3 * sigma[2]);
  EXPECT_NEAR(a.T_target_source.t.y(), 0, 0.02);
}

TEST_P(RegistrationLaws, AFlatPlaneHoldsHeightAndTiltOnly) {
  const auto method = make("{search_radius: 0, search_yaw: 0}");
  Cloud plane;
  add_wall(plane, {-10, -10, -1}, {20, 0, 0}, {0, 20, 0});
  const Alignment a = align(*method, plane, plane, motion(0, 0, 0.1, 0.01, 0, 0));
  ASSERT_TRUE(a.T_target_source.finite());
  const Vec6 sigma = sigmas(a.information);
  for (const int weak : {0, 1, 5}) {
    EXPECT_GT(sigma[weak], 10 * sigma[2]) << weak;
    EXPECT_GT(sigma[weak], 10 * sigma[3]) << weak;
  }
}

TEST_P(RegistrationLaws, ThresholdsDecideAndAreNamed) {
  const Cloud a = forest_scan(SE3{}), b = forest_scan(motion(8, 0, 0, 0, 0, 0));
  const SE3 guess = motion(8, 0, 0, 0, 0, 0);
  const Alignment strict = align(*make("{min_overlap: 0.99}"), a, b, guess);
  EXPECT_FALSE(strict.converged);
  EXPECT_NE(strict.reason.find("min_overlap"), std::string::npos) << strict.reason;
  const Alignment exact = align(*make("{max_rmse: 0.0001, min_overlap: 0}"), a, b, guess);
  EXPECT_FALSE(exact.converged);
  EXPECT_NE(exact.reason.find("max_rmse"), std::string::npos) << exact.reason;
}

TEST_P(RegistrationLaws, ParametersThatContradictEachOtherAreRefused) {
  EXPECT_THROW(make("{voxel_size: 2.0, coarse_voxel_size: 1.0}"), Error);
  EXPECT_THROW(make("{neighbours: 60, min_points: 50}"), Error);
}

}  // namespace cambium::testing
