// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <numbers>
#include <random>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

double ground(double x, double y) { return 0.2 * x + 1.5 * std::sin(y / 9); }

struct Pine {
  double x, y, height;
};
const std::vector<Pine> pines{{0, 0, 18}, {6, 1, 22}, {-5, 4, 15}, {2, 9, 20}, {-7, -6, 9}};

/// What a drone sees: the ground between the trees, and cones for crowns. z is up.
Cloud from_above(bool hidden_ground = false) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-15, 15), unit(0, 1);
  Cloud cloud;
  const auto add = [&](double x, double y, double z) {
    for (const double v : {x, y, z}) cloud.xyz.push_back(float(v));
  };
  for (int i = 0; i < 20000; ++i) {
    const double x = any(random), y = any(random);
    if (hidden_ground && std::hypot(x, y) < 5) continue;
    add(x, y, ground(x, y) + 0.02 * any(random) / 15);
  }
  for (const Pine& p : pines)
    for (int i = 0; i < 1500; ++i) {
      const double down = std::sqrt(unit(random)), angle = 2 * std::numbers::pi * unit(random);
      const double r = 1.8 * down;
      add(p.x + r * std::cos(angle), p.y + r * std::sin(angle),
          ground(p.x, p.y) + p.height * (1 - 0.5 * down));
    }
  return cloud;
}

std::vector<Tree> tops(Cloud cloud, const SE3& T_mission_node = {},
                       const std::string& yaml = "{}") {
  Mission mission = make_mission("a", {T_mission_node});
  mission.nodes[0].payload = in_memory(transformed(T_mission_node.inverse(), cloud));
  return *component<PayloadFilter>("tree_tops", yaml)
              ->apply({make_atlas({mission}), 0}, 0, *make_context())
              .trees;
}

void expect_pines(const std::vector<Tree>& found, const SE3& T_mission_node = {}) {
  ASSERT_EQ(found.size(), pines.size());
  for (const Pine& p : pines) {
    double least = 1e9, height = 0;
    for (const Tree& t : found) {
      const Vec3 base = T_mission_node * t.base;
      const double d = std::hypot(base.x() - p.x, base.y() - p.y);
      if (d < least) least = d, height = base.z();
      EXPECT_TRUE(std::isnan(t.dbh));
      EXPECT_NEAR((T_mission_node.q * t.axis).z(), 1, 1e-12);
    }
    EXPECT_LT(least, 0.3);
    EXPECT_NEAR(height, ground(p.x, p.y), 0.6);  // the lowest point of a cell on a slope
  }
}

TEST(TreeTops, FindsEveryTopAndTheGroundBelowIt) { expect_pines(tops(from_above())); }

TEST(TreeTops, GroundThatTheCanopyHidesComesFromAround) { expect_pines(tops(from_above(true))); }

TEST(TreeTops, ATiltedSensorSeesTheSameTrees) {
  Vec6 xi;
  xi << 4, -3, 40, 0.2, -0.15, 1.1;
  const SE3 T = SE3::exp(xi);
  expect_pines(tops(from_above(), T), T);
}

TEST(TreeTops, LowVegetationAndBareGroundHaveNoTops) {
  EXPECT_EQ(tops(from_above(), {}, "{min_height: 16}").size(), 3u);
  EXPECT_TRUE(tops(Cloud{}).empty());
  Cloud odd;
  odd.xyz = {std::numeric_limits<float>::quiet_NaN(), 0, 0, 1e30f, 0, 0, 1, 2, 3};
  EXPECT_TRUE(tops(odd).empty());
}

TEST(TreeTops, WithOnlyAboveNodesOnTheGroundStayAsTheyAre) {
  Mission mission = make_mission("a", {SE3{}, SE3{}});
  for (const double height : {1.5, 60.0}) {
    Payload payload;
    payload.cloud = std::make_shared<const Cloud>(
        transformed({Quat::Identity(), {0, 0, -height}}, from_above()));
    payload.trees = std::make_shared<const std::vector<Tree>>(2);
    mission.nodes[height > 10].payload = in_memory(payload);
  }
  const Atlas atlas = make_atlas({mission});
  const auto filter = component<PayloadFilter>("tree_tops", "{only_above: true}");
  EXPECT_EQ(filter->apply({atlas, 0}, 0, *make_context()).trees->size(), 2u);
  EXPECT_EQ(filter->apply({atlas, 0}, 1, *make_context()).trees->size(), pines.size());
}

TEST(TreeTops, NodesWithoutACloudStayAsTheyAre) {
  const Atlas atlas = make_atlas({make_mission("a", {SE3{}})});
  EXPECT_FALSE(
      component<PayloadFilter>("tree_tops", "{}")->apply({atlas, 0}, 0, *make_context()).trees);
}

}  // namespace
}  // namespace cambium::testing
