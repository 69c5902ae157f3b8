// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <random>

#include "support/maps.hpp"

namespace cambium::testing {
namespace {

constexpr double slope = 0.2;  // metres up a metre east

/// A slope with stems on it, seen from T_world_base up to 12 m away. No noise: figures are exact.
Cloud scan(const SE3& T_world_base, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-12, 12), height(0.4, 6);
  Cloud cloud;
  const auto add = [&](double x, double y, double above) {
    const Vec3 p = T_world_base.inverse() * Vec3(x, y, slope * x + above);
    for (int axis = 0; axis < 3; ++axis) cloud.xyz.push_back(float(p[axis]));
  };
  for (int i = 0; i < 9000; ++i)
    add(T_world_base.t.x() + uniform(random), T_world_base.t.y() + uniform(random), 0);
  for (int i = 0; i < 600; ++i) add(3, 2, height(random));
  return cloud;
}

Atlas hillside() {
  std::vector<Mission> missions;
  for (unsigned m = 0; m < 2; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i)
      poses.push_back(SE3::from_yaw(0.4 * i, {4.0 * i, 3.0 * m, 1.5 + slope * 4.0 * i}));
    missions.push_back(make_mission(m ? "b" : "a", poses));
    for (unsigned i = 0; i < 3; ++i)
      missions[m].nodes[i].payload = in_memory(scan(poses[i], 10 * m + i));
  }
  return tied(make_atlas(missions));
}

std::map<std::string, double> separation(const Atlas& atlas, const std::string& yaml = "{}",
                                         int threads = 1) {
  return evaluate("ground_separation", atlas, {}, yaml, threads);
}

TEST(GroundSeparation, IsZeroForAnExactMapOnASlope) {
  const auto m = separation(hillside());
  EXPECT_LT(m.at("ground_separation.rms"), 1e-4);
  EXPECT_GT(m.at("ground_separation.cells"), 500);
}

// Lifting a mission by d lifts its ground by d; shifting it uphill by d lowers it by slope * d.
TEST(GroundSeparation, MeasuresAKnownBend) {
  for (const double d : {0.1, 0.3, 4.0}) {
    const auto lifted = separation(moved(hillside(), 1, SE3::from_yaw(0, {0, 0, d})));
    EXPECT_NEAR(lifted.at("ground_separation.rms"), d, 1e-4);
    EXPECT_NEAR(lifted.at("ground_separation.median"), d, 1e-4);
    EXPECT_NEAR(lifted.at("ground_separation.a.b.rms"), d, 1e-4);
  }
  const auto shifted = separation(moved(hillside(), 1, SE3::from_yaw(0, {1.5, 0, 0})));
  EXPECT_NEAR(shifted.at("ground_separation.rms"), slope * 1.5, 0.01);
}

TEST(GroundSeparation, MissionsThatSawNothingTogetherHaveNone) {
  const auto m = separation(moved(hillside(), 1, SE3::from_yaw(0, {200, 0, 0})));
  EXPECT_EQ(m.at("ground_separation.cells"), 0);
  EXPECT_EQ(m.count("ground_separation.rms"), 0u);
  Atlas islands = hillside();
  islands.islands = {{{0}, {}}, {{1}, {}}};
  islands.missions[1].island = 1;
  EXPECT_EQ(separation(islands).at("ground_separation.cells"), 0);
}

TEST(GroundSeparation, AnyNumberOfThreadsGivesTheSameFigures) {
  const Atlas atlas = moved(hillside(), 1, SE3::from_yaw(0.01, {0.1, 0, 0.03}));
  EXPECT_EQ(separation(atlas), separation(atlas, "{}", 4));
}

TEST(GroundSeparation, TakesCloudsThatSayNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& xyz : {std::vector<float>{}, std::vector<float>(30, nan),
                                        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}}) {
    Cloud cloud;
    cloud.xyz = xyz;
    Mission a = make_mission("a", {SE3{}}), b = make_mission("b", {SE3{}});
    a.nodes[0].payload = in_memory(cloud);  // b has no payload at all
    EXPECT_EQ(separation(tied(make_atlas({a, b}))).at("ground_separation.cells"), 0);
  }
}

}  // namespace
}  // namespace cambium::testing
