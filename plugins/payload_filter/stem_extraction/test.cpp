// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "forest.hpp"

namespace stem_extraction::testing {
namespace {

using namespace cambium;
using namespace cambium::testing;

/// The reported tree nearest to a true one.
const Tree& nearest(const std::vector<Tree>& found, const Tree& tree) {
  return *std::min_element(found.begin(), found.end(), [&](const Tree& a, const Tree& b) {
    return (a.base - tree.base).norm() < (b.base - tree.base).norm();
  });
}

std::vector<Tree> add_stand(Scene& scene) {
  scene.add_ground();
  return {scene.add_stem(3, 2, 0.2),      scene.add_stem(-5, 4, 0.35, {0.05, 0.03, 1}),
          scene.add_stem(8, -6, 0.12),    scene.add_stem(-10, -8, 0.5, {-0.08, 0.02, 1}),
          scene.add_stem(4.5, 2.5, 0.15), scene.add_stem(0, 14, 0.28, {0.02, 0.1, 1})};
}

void expect_all(const std::vector<Tree>& found, const std::vector<Tree>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (const Tree& t : expected) {
    const Tree& f = nearest(found, t);
    EXPECT_LT((f.base - t.base).head<2>().norm(), 0.04) << t.base.transpose();
    EXPECT_LT(std::abs(f.base.z() - t.base.z()), 0.08) << t.base.transpose();
    EXPECT_NEAR(f.dbh, t.dbh, 0.015) << t.base.transpose();
    EXPECT_GT(f.axis.dot(t.axis), std::cos(0.02)) << t.base.transpose();
    EXPECT_NEAR(f.axis.norm(), 1, 1e-9);
    EXPECT_GT(f.score, 0.5);
    EXPECT_LE(f.score, 1.0);
    EXPECT_TRUE(f.reconstructed);
  }
}

TEST(StemExtraction, FindsTheStemsOnLevelAndOnSlopedGround) {
  for (const double slope : {0.0, 0.2, std::tan(20 * M_PI / 180)}) {
    Scene scene;
    scene.slope = slope;
    const auto expected = add_stand(scene);
    expect_all(trees(scene.cloud), expected);
  }
}

TEST(StemExtraction, FindsTheStemsInRingsOfASparseLidar) {
  Scene scene;
  scene.ring = 0.3;
  scene.points = 150;
  const auto expected = add_stand(scene);
  expect_all(trees(scene.cloud), expected);
}

TEST(StemExtraction, SnagsLeavesAndLogsAreNoTrees) {
  Scene scene;
  scene.add_ground();
  scene.top = 2.5;
  scene.add_stem(5, 5, 0.2);                // a snag
  for (std::uint64_t i = 0; i < 4000; ++i)  // a bush, and a crown
    scene.add({4 * number(4, i) - 8, 3 * number(5, i), 3 * number(6, i) - 1.5});
  for (std::uint64_t i = 0; i < 1000; ++i)  // a log on the ground
    scene.add({5 + 4 * number(7, i), -5 + 0.1 * normal(8, i), -1.3 + 0.1 * normal(9, i)});
  EXPECT_TRUE(trees(scene.cloud).empty());
}

TEST(StemExtraction, TreesAreInTheBaseFrameHoweverItIsTilted) {
  Scene scene;
  const auto expected = add_stand(scene);
  Vec6 xi;
  xi << 0, 0, 0, 0.2, -0.15, 0;
  const SE3 T = SE3::exp(xi);  // T_level_base
  std::vector<Tree> tilted = expected;
  for (Tree& t : tilted) t.base = T.inverse() * t.base, t.axis = T.inverse().q * t.axis;
  expect_all(trees(transformed(T.inverse(), scene.cloud), "{}", T), tilted);
}

TEST(StemExtraction, TheSameForAnyOrderOfThePoints) {
  Scene scene;
  add_stand(scene);
  std::vector<std::size_t> shuffled(scene.cloud.size());
  for (std::size_t i = 0; i < shuffled.size(); ++i) shuffled[i] = (i * 7919) % shuffled.size();
  const auto a = trees(scene.cloud), b = trees(select(scene.cloud, shuffled));
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i].dbh, b[i].dbh, 1e-9);
}

TEST(StemExtraction, JoinedScansAreAlignedOnTheStems) {
  std::vector<SE3> poses;
  for (int i = 0; i < 5; ++i) poses.push_back(SE3::from_yaw(0, {1.0 * i, 0, 0}));
  Mission mission = make_mission("a", poses);
  std::vector<Tree> expected;
  for (int i = 0; i < 5; ++i) {
    Scene scene;
    scene.points = 200;
    scene.eye = i;
    expected = add_stand(scene);
    mission.nodes[std::size_t(i)].payload =
        in_memory(transformed(poses[std::size_t(i)].inverse(), scene.cloud));
    // What the robot believes: it drifts to the side and turns.
    const double d = i - 2;
    mission.nodes[std::size_t(i)].T_mission_node =
        SE3::from_yaw(0.001 * d, {1.0 * i, 0.012 * d, 0});
  }
  const SE3 T_node_world = poses[2].inverse();
  for (Tree& t : expected) t.base = T_node_world * t.base;
  const Atlas atlas = make_atlas({mission});
  const auto filter = component<PayloadFilter>("stem_extraction", "{join_radius: 10}");
  expect_all(*filter->apply({atlas, 0}, 2, *make_context()).trees, expected);
}

TEST(StemExtraction, TheCloudStaysUnlessItIsNotWanted) {
  Scene scene;
  add_stand(scene);
  const auto cloud = std::make_shared<const Cloud>(scene.cloud);
  EXPECT_EQ(apply({cloud, nullptr}).cloud, cloud);
  const Payload out = apply({cloud, nullptr}, "{keep_cloud: false}");
  EXPECT_EQ(out.cloud, nullptr);
  EXPECT_EQ(out.trees->size(), 6u);
}

TEST(StemExtraction, CloudsWithoutTreesGiveEmptyTables) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(trees(Cloud{}).empty());
  Cloud bad;
  bad.xyz = {nan, 0, 0, 1e30f, 1, 1, 2, 2, 2};
  EXPECT_TRUE(trees(bad).empty());
  Scene bare;
  bare.add_ground();
  EXPECT_TRUE(trees(bare.cloud).empty());
  const auto table = std::make_shared<const std::vector<Tree>>(2);
  EXPECT_EQ(apply({nullptr, table}).trees, table) << "a node without a cloud keeps its table";
}

TEST(StemExtraction, RefusesBadParameters) {
  for (const char* yaml : {"{min_dbh: 0}", "{min_dbh: 0.5, max_dbh: 0.4}", "{max_slope: 2}",
                           "{min_score: 2}", "{min_points: 1}", "{dbh: 1}"})
    EXPECT_THROW(component<PayloadFilter>("stem_extraction", yaml), Error) << yaml;
  EXPECT_TRUE(component<PayloadFilter>("stem_extraction")->uses_neighbours());
}

}  // namespace
}  // namespace stem_extraction::testing
