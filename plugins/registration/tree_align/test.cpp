// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

SE3 motion(double x, double y, double z, double yaw) { return SE3::from_yaw(yaw, {x, y, z}); }

std::vector<Tree> stand(std::size_t count) {
  std::vector<Tree> trees;
  std::uint64_t state = 7;
  const auto next = [&] {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return double(state >> 33) / double(1u << 31);
  };
  for (std::size_t i = 0; i < count; ++i) {
    Tree t;
    t.base = Vec3(40 * next() - 20, 40 * next() - 20, next() - 2);
    t.dbh = 0.1 + 0.4 * next();
    trees.push_back(t);
  }
  return trees;
}

std::vector<Tree> moved(const SE3& T, std::vector<Tree> trees) {
  for (Tree& t : trees) t.base = T * t.base, t.axis = T.q * t.axis;
  return trees;
}

Prepared prepared(std::vector<Tree> trees) {
  return {{nullptr, std::make_shared<const std::vector<Tree>>(std::move(trees))}, {}, 0};
}

Alignment align(const std::vector<Tree>& target, const std::vector<Tree>& source, const SE3& guess,
                const std::string& yaml = "{}") {
  return component<Registration>("tree_align", yaml)
      ->align(prepared(target), prepared(source), guess, *make_context());
}

TEST(TreeAlign, FindsTheMotionFromAGuessThatIsOff) {
  const SE3 T = motion(6, -4, 0.5, 0.8);
  const auto source = stand(80);
  const Alignment a = align(moved(T, source), source, motion(6.4, -4.3, 0.2, 0.81));
  ASSERT_TRUE(a.converged) << a.reason;
  EXPECT_LT((a.T_target_source.t - T.t).norm(), 0.01);
  EXPECT_LT(rotation_angle(a.T_target_source.inverse() * T), 0.001);
}

TEST(TreeAlign, TheInverseOfTheSwappedPair) {
  const SE3 T = motion(6, -4, 0.5, 0.8);
  const auto source = stand(80), target = moved(T, source);
  const SE3 there = align(target, source, T).T_target_source;
  const SE3 back = align(source, target, T.inverse()).T_target_source;
  EXPECT_LT((there * back).log().norm(), 1e-3);
}

TEST(TreeAlign, TiltIsCorrectedWhenAskedFor) {
  Vec6 xi = Vec6::Zero();
  xi[3] = 0.03;
  const auto source = stand(80), target = moved(SE3::exp(xi), source);
  const Alignment keeps = align(target, source, SE3{});
  const Alignment corrects =
      align(target, source, SE3{}, "{correct_tilt: true, sigma_tilt: 1, sigma_base: 0.05}");
  EXPECT_NEAR(rotation_angle(keeps.T_target_source.inverse() * SE3::exp(xi)), 0.03, 0.003);
  EXPECT_LT(rotation_angle(corrects.T_target_source.inverse() * SE3::exp(xi)), 0.003);
}

std::vector<Tree> lifted(std::vector<Tree> trees, double height, std::size_t every = 1) {
  for (std::size_t i = 0; i < trees.size(); i += every) trees[i].base.z() += height;
  return trees;
}

TEST(TreeAlign, ALessThanCommonGroundDoesNotLift) {
  const auto source = stand(80), target = lifted(source, 1.5, 6);  // a sixth of the bases is off
  EXPECT_NEAR(align(target, source, SE3{}).T_target_source.t.z(), 0, 0.02);
}

TEST(TreeAlign, HeightsThatContradictTheGuessAreLeftOpen) {
  const auto source = stand(80), target = lifted(source, 1.0);
  const Alignment doubts = align(target, source, SE3{}),
                  believes = align(target, source, SE3{}, "{max_height_change: 2}");
  EXPECT_NEAR(doubts.T_target_source.t.z(), 0, 1e-6);
  EXPECT_LT(doubts.information(2, 2), 0.02) << "max_sigma is 10";
  EXPECT_NEAR(believes.T_target_source.t.z(), 1, 1e-3);
  EXPECT_GT(believes.information(2, 2), 1);
}

// A robot's base frame may lean by ten degrees: it is the stems that say where up is.
TEST(TreeAlign, HeightsAreAlongTheStemsNotAlongTheRobot) {
  Vec6 xi = Vec6::Zero();
  xi[4] = 0.25;
  const SE3 T_tilted_level = SE3::exp(xi);
  const auto level = stand(80);
  const Alignment a =
      align(moved(T_tilted_level, lifted(level, 1.0)), moved(T_tilted_level, level), SE3{});
  const Mat3 R = T_tilted_level.rotation();
  const Mat3 information = R.transpose() * a.information.topLeftCorner<3, 3>() * R;
  EXPECT_LT(information(2, 2), 0.02) << "height is open";
  EXPECT_GT(information(0, 0), 100);
  EXPECT_LT(a.T_target_source.t.norm(), 1e-3) << "no height leaks into the plane";
}

TEST(TreeAlign, InformationIsPositiveDefiniteAndWeakWhereNothingHolds) {
  const auto trees = stand(60);
  const Mat6 information = align(trees, trees, SE3{}).information;
  EXPECT_EQ(information, Mat6(information.transpose()));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(information);
  EXPECT_GE(eigen.eigenvalues().minCoeff(), 0.01 * (1 - 1e-6));  // max_sigma is 10
  EXPECT_GT(information(0, 0), 10 * information(2, 2)) << "heights are known worse";
}

TEST(TreeAlign, BadTablesAreNoConvergenceAndSayWhy) {
  const auto good = stand(60);
  auto bad = good;
  for (Tree& t : bad) t.base.x() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& table : {std::vector<Tree>{}, stand(3), bad})
    for (const Alignment& a : {align(good, table, SE3{}), align(table, good, SE3{})}) {
      EXPECT_FALSE(a.converged);
      EXPECT_NE(a.reason.find("min_matches"), std::string::npos) << a.reason;
    }
  const auto method = component<Registration>("tree_align");
  EXPECT_NE(method->align({}, prepared(good), SE3{}, *make_context()).reason.find("target"),
            std::string::npos);
  SE3 guess;
  guess.t.x() = std::numeric_limits<double>::infinity();
  EXPECT_NE(align(good, good, guess).reason.find("guess"), std::string::npos);
}

TEST(TreeAlign, AnotherPlaceDoesNotConverge) {
  const auto here = stand(60);
  EXPECT_FALSE(align(here, moved(motion(1e3, 0, 0, 0), here), SE3{}).converged);
}

TEST(TreeAlign, RefusesBadParameters) {
  for (const char* yaml : {"{radius: 2}", "{min_matches: 2}", "{sigma_stem: 0}", "{radios: 1}"})
    EXPECT_THROW(component<Registration>("tree_align", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
