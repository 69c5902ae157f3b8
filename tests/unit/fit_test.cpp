// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "cambium/error.hpp"

namespace cambium {
namespace {

std::vector<Vec3> random_points(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-50, 50);
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < n; ++i)
    points.emplace_back(uniform(random), uniform(random), uniform(random));
  return points;
}

std::vector<Vec3> moved(const SE3& T, const std::vector<Vec3>& points) {
  std::vector<Vec3> out;
  for (const Vec3& p : points) out.push_back(T * p);
  return out;
}

double cost(const SE3& T, const std::vector<Vec3>& target, const std::vector<Vec3>& source,
            const std::vector<double>& weights) {
  double sum = 0;
  for (std::size_t i = 0; i < target.size(); ++i)
    sum += weights[i] * (target[i] - T * source[i]).squaredNorm();
  return sum;
}

double distance(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(Fit, YawFindsTheTransformOfExactPoints) {
  const SE3 T = SE3::from_yaw(-2.5, {100, -30, 7});
  const auto source = random_points(5, 1);
  EXPECT_LT(distance(fit_yaw(moved(T, source), source), T), 1e-10);
}

TEST(Fit, RigidFindsTheTransformOfExactPoints) {
  Vec6 xi;
  xi << 4, -5, 6, 0.5, -1.1, 2.0;
  const SE3 T = SE3::exp(xi);
  const auto source = random_points(5, 2);
  EXPECT_LT(distance(fit_rigid(moved(T, source), source), T), 1e-10);
}

TEST(Fit, YawIsTheMinimumOfTheWeightedCost) {
  const auto source = random_points(20, 3), target = random_points(20, 4);
  std::vector<double> weights;
  for (int i = 0; i < 20; ++i) weights.push_back(1 + i % 5);
  const SE3 best = fit_yaw(target, source, weights);
  const double lowest = cost(best, target, source, weights);
  for (const double step : {-1e-3, 1e-3}) {
    for (int axis = 0; axis < 3; ++axis) {
      SE3 shifted = best;
      shifted.t[axis] += step;
      EXPECT_GT(cost(shifted, target, source, weights), lowest);
    }
    EXPECT_GT(cost(best * SE3::from_yaw(step), target, source, weights), lowest);
  }
}

TEST(Fit, YawKeepsTheVerticalVertical) {
  const SE3 T = fit_yaw(random_points(9, 5), random_points(9, 6));
  EXPECT_LT((T.q * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-14);
}

TEST(Fit, RigidNeverReflects) {
  const auto source = random_points(8, 7);
  std::vector<Vec3> mirrored = source;
  for (Vec3& p : mirrored) p.x() = -p.x();
  EXPECT_NEAR(fit_rigid(mirrored, source).rotation().determinant(), 1.0, 1e-12);
}

TEST(Fit, OnePairGivesATranslation) {
  const std::vector<Vec3> target{{1, 2, 3}}, source{{0, 0, 1}};
  EXPECT_LT(distance(fit_yaw(target, source), SE3::from_yaw(0, {1, 2, 2})), 1e-14);
}

TEST(Fit, RefusesUnequalAndEmptySets) {
  EXPECT_THROW(fit_yaw({}, {}), Error);
  EXPECT_THROW(fit_rigid(random_points(3, 1), random_points(4, 1)), Error);
}

}  // namespace
}  // namespace cambium
