// SPDX-License-Identifier: BSD-3-Clause
#include "engine/upright_path.hpp"

#include <cmath>
#include <numbers>

#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

constexpr double degree = std::numbers::pi / 180;

/// A round of 40 m by 24 m on gentle ground, as a frame has it that is rolled against the level
/// one.
Mission loop(double roll_deg, double across = 12.0, double hills = 0.5) {
  SE3 T_frame_level;
  T_frame_level.q = Quat(Eigen::AngleAxisd(roll_deg * degree, Vec3::UnitX()));
  std::vector<SE3> poses;
  for (int i = 0; i < 60; ++i) {
    const double a = 2 * std::numbers::pi * i / 60;
    poses.push_back(T_frame_level * SE3::from_yaw(a, {20 * std::cos(a), across * std::sin(a),
                                                      hills * std::sin(3 * a)}));
  }
  return make_mission("a", poses);
}

}  // namespace

TEST(UprightPath, ZForwardIsSeenByThePath) {
  const auto off = upright_path(loop(90));
  ASSERT_TRUE(off);
  EXPECT_NEAR(*off, 90 * degree, 2 * degree);
  EXPECT_TRUE(upright_path(loop(-90)));
  EXPECT_TRUE(upright_path(loop(70)));
}

TEST(UprightPath, HillsidesAreNoWrongFrames) {
  for (const double roll : {-45.0, -20.0, 0.0, 5.0, 30.0, 50.0, 180.0})
    EXPECT_FALSE(upright_path(loop(roll))) << roll;
}

TEST(UprightPath, WhatSaysNothingIsNotJudged) {
  EXPECT_FALSE(upright_path(loop(90, 1.0)));         // there and back again on one line
  EXPECT_FALSE(upright_path(loop(90, 12.0, 10.0)));  // a drone that uses all three dimensions
  EXPECT_FALSE(upright_path(make_mission("a", {SE3()})));
}
