// SPDX-License-Identifier: BSD-3-Clause
#include "engine/frames.hpp"

#include <algorithm>

#include "engine/graph.hpp"
#include "support/support.hpp"

using namespace cambium;

namespace {

std::vector<SE3> straight_path(int n) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) poses.push_back(SE3::from_yaw(0.05 * i, {2.0 * i, 0.3 * i, 0}));
  return poses;
}

// The same path, written in a frame that T_a_own moves onto that of the path.
std::vector<SE3> seen_from(const SE3& T_a_own, const std::vector<SE3>& path) {
  std::vector<SE3> poses;
  for (const SE3& T : path) poses.push_back(T_a_own.inverse() * T);
  return poses;
}

Loop accepted(NodeRef tail, NodeRef head, const SE3& T) {
  Loop loop;
  loop.tail = tail;
  loop.head = head;
  loop.T_tail_head = T;
  loop.state = LoopState::accepted;
  return loop;
}

Atlas join(Atlas atlas) {
  return join_islands(std::move(atlas), [](const std::string& w) { FAIL() << w; });
}

const SE3 T_a_b = SE3::from_yaw(1.2, {30, -20, 5});

Atlas two_missions(int wrong) {
  const auto path = straight_path(20);
  Atlas atlas =
      cambium::testing::make_atlas({cambium::testing::make_mission("a", path),
                                    cambium::testing::make_mission("b", seen_from(T_a_b, path))});
  for (std::uint32_t i = 0; i < 20; ++i) {
    // The first ones are wrong, so that "take the first loop" would fail.
    const SE3 T = int(i) < wrong ? SE3::from_yaw(0.7 * i, {9.0 + i, 4, 0}) : SE3{};
    atlas.loops.push_back(accepted({0, i}, {1, i}, T));
  }
  return atlas;
}

}  // namespace

TEST(JoinIslands, PlacesAMissionByWhatMostLoopsSay) {
  for (const int wrong : {0, 1, 9}) {
    const Atlas joined = join(two_missions(wrong));
    ASSERT_EQ(joined.islands.size(), 1u);
    for (std::uint32_t i = 0; i < 20; ++i)
      EXPECT_LT((joined.T_map_node({0, i}).t - joined.T_map_node({1, i}).t).norm(), 1e-9);
    EXPECT_EQ(joined.T_map_node({0, 3}).t,
              two_missions(0).T_map_node({0, 3}).t);  // a gives the frame
  }
}

TEST(JoinIslands, MissionsWithoutAcceptedLoopsStayIslands) {
  Atlas atlas = two_missions(0);
  for (Loop& loop : atlas.loops) loop.state = LoopState::rejected;
  const Atlas joined = join(atlas);
  ASSERT_EQ(joined.islands.size(), 2u);
  EXPECT_EQ(joined.islands[1].missions, std::vector<std::uint32_t>{1});
  EXPECT_EQ(joined.T_map_node({1, 5}).t, atlas.T_map_node({1, 5}).t);
}

TEST(JoinIslands, ChainsAndLaterWavesGrowTheSameIsland) {
  const auto path = straight_path(5);
  Atlas atlas = cambium::testing::make_atlas(
      {cambium::testing::make_mission("a", path),
       cambium::testing::make_mission("b", seen_from(T_a_b, path)),
       cambium::testing::make_mission("c", seen_from(T_a_b.inverse(), path))});
  atlas.loops = {accepted({1, 2}, {2, 2}, SE3{})};
  atlas = join(atlas);
  ASSERT_EQ(atlas.islands.size(), 2u);
  EXPECT_EQ(atlas.islands[1].missions, (std::vector<std::uint32_t>{1, 2}));
  atlas.loops.push_back(accepted({0, 1}, {2, 1}, SE3{}));
  atlas = join(atlas);
  ASSERT_EQ(atlas.islands.size(), 1u);
  for (std::uint32_t m = 0; m < 3; ++m)
    EXPECT_LT((atlas.T_map_node({m, 4}).t - path[4].t).norm(), 1e-9) << m;
}

TEST(BuildGraph, HoldsTheFirstNodeOrWhatFixNames) {
  Atlas atlas = join(two_missions(0));
  const auto no_warning = [](const std::string& w) { FAIL() << w; };
  IslandGraph g = build_graph(atlas, 0, 0, {}, no_warning);
  EXPECT_EQ(g.nodes.size(), 40u);
  EXPECT_EQ(g.loops.size(), 20u);
  EXPECT_EQ(g.graph.relative.size(), 19u + 19u + 20u);
  EXPECT_TRUE(g.graph.relative.back().robust);
  EXPECT_FALSE(g.graph.relative.front().robust);
  EXPECT_EQ(std::count(g.graph.fixed.begin(), g.graph.fixed.end(), true), 1);
  EXPECT_TRUE(g.graph.fixed[0]);

  Mission fixed = *atlas.missions[0].mission;
  fixed.nodes[7].fixed = true;
  atlas.missions[0].mission = std::make_shared<const Mission>(fixed);
  g = build_graph(atlas, 0, 0, {}, no_warning);
  EXPECT_TRUE(g.graph.fixed[7]);
  EXPECT_FALSE(g.graph.fixed[0]);
}

TEST(BuildGraph, AttitudeFactorsAgreeWithWhereTheMissionIs) {
  const Atlas atlas = join(two_missions(0));
  const IslandGraph g = build_graph(atlas, 0, 0.02, {}, [](const std::string&) {});
  ASSERT_EQ(g.graph.attitude.size(), 40u);
  PoseGraph only = g.graph;
  only.relative.clear();
  EXPECT_LT(cost(only, only.T_map_node), 1e-18);
}

TEST(BuildGraph, PositionsOfTheIslandBecomeFactorsAndHoldTheGauge) {
  Atlas atlas = two_missions(0);
  atlas.islands = {{{0, 1}, {}, {}}};
  atlas.missions[1].island = 0;
  const auto quiet = [](const std::string&) {};
  for (std::uint32_t i = 0; i < 4; ++i)
    atlas.islands[0].positions.push_back({{1, i}, Vec3(i, 1, 2), 3 * Mat3::Identity()});
  IslandGraph g = build_graph(atlas, 0, 0, {}, quiet);
  ASSERT_EQ(g.graph.positions.size(), 4u);
  EXPECT_EQ(g.graph.positions[2].node, 22u);
  EXPECT_EQ(g.graph.positions[2].t_map, Vec3(2, 1, 2));
  EXPECT_TRUE(g.graph.positions[2].robust);
  EXPECT_EQ(std::count(g.graph.fixed.begin(), g.graph.fixed.end(), true), 0);
  EXPECT_EQ(g.graph.attitude.size(), 1u);  // a straight path would be free to roll
  atlas.islands[0].positions.resize(2);
  g = build_graph(atlas, 0, 0, {}, quiet);
  EXPECT_TRUE(g.graph.fixed[0]);
}

TEST(BuildGraph, AMissionThatIsNotLevelHasNoAttitudeFactors) {
  Atlas atlas = two_missions(0);
  atlas.islands = {{{0, 1}, {}, {}}};
  atlas.missions[1].island = 0;
  const IslandGraph g = build_graph(atlas, 0, 0.02, {1}, [](const std::string&) {});
  ASSERT_EQ(g.graph.attitude.size(), 20u);
  for (const auto& f : g.graph.attitude) EXPECT_LT(f.node, 20u);
}

TEST(JoinIslands, TheOrderOfTheMissionsDoesNotShow) {
  std::vector<Mission> missions;
  for (const char* name : {"a", "b", "c", "d"})
    missions.push_back(cambium::testing::make_mission(
        name, seen_from(SE3::from_yaw(0.3 * name[0], {1.0 * name[0], 2, 3}), straight_path(20))));
  const auto fused = [&](const std::vector<int>& order) {
    std::vector<Mission> named;
    for (const int i : order) named.push_back(missions[std::size_t(i)]);
    Atlas atlas = cambium::testing::make_atlas(named);  // sorts by name, as the engine does
    for (std::uint32_t a = 0; a < 4; ++a)
      for (std::uint32_t i = 0; i < 20; ++i)
        atlas.loops.push_back(
            accepted({a, i}, {(a + 1) % 4, i}, SE3::from_yaw(1e-3 * i, {0.01 * i, 0, 0})));
    return join(std::move(atlas));
  };
  const Atlas first = fused({0, 1, 2, 3});
  ASSERT_EQ(first.islands.size(), 1u);
  std::vector<int> order{0, 1, 2, 3};
  while (std::next_permutation(order.begin(), order.end())) {
    const Atlas other = fused(order);
    for (std::uint32_t m = 0; m < 4; ++m)
      for (std::uint32_t n = 0; n < 20; ++n) {
        EXPECT_EQ(first.T_map_node({m, n}).t, other.T_map_node({m, n}).t);
        EXPECT_EQ(first.T_map_node({m, n}).q.coeffs(), other.T_map_node({m, n}).q.coeffs());
      }
  }
}

namespace {

/// Four missions over one path, each in its own frame; T_path_own of mission m.
SE3 frame_of(std::uint32_t m) { return SE3::from_yaw(0.9 * m, {40.0 * m, -15.0 * m, 0.5 * m}); }

Atlas four_missions() {
  std::vector<Mission> missions;
  for (std::uint32_t m = 0; m < 4; ++m)
    missions.push_back(cambium::testing::make_mission(
        std::string(1, char('a' + m)), seen_from(m == 0 ? SE3{} : frame_of(m), straight_path(20))));
  return cambium::testing::make_atlas(std::move(missions));
}

/// `count` loops from every node of the path to the same place in the other mission, moved by `T`.
void tie(Atlas& atlas, std::uint32_t a, std::uint32_t b, std::uint32_t count, const SE3& T = {}) {
  for (std::uint32_t i = 0; i < count; ++i) atlas.loops.push_back(accepted({a, i}, {b, i}, T));
}

double furthest_apart(const Atlas& atlas) {
  double worst = 0;
  for (std::uint32_t m = 1; m < 4; ++m)
    for (std::uint32_t i = 0; i < 20; ++i)
      worst = std::max(worst, (atlas.T_map_node({m, i}).t - atlas.T_map_node({0, i}).t).norm());
  return worst;
}

}  // namespace

TEST(JoinIslands, APairWithMostLoopsButAgainstAllOthersDoesNotBendTheFrames) {
  Atlas atlas = four_missions();
  // A spanning tree along the pairs with most loops would begin with the wrong one.
  tie(atlas, 0, 3, 20, SE3::from_yaw(2.5, {60, -30, 2}));
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {0, 2}, {1, 3}})
    tie(atlas, std::uint32_t(a), std::uint32_t(b), 8);
  std::vector<std::string> warnings;
  const Atlas joined = join_islands(atlas, [&](const std::string& w) { warnings.push_back(w); });
  ASSERT_EQ(joined.islands.size(), 1u);
  EXPECT_LT(furthest_apart(joined), 1e-6);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the 20 loops between 'a' and 'd'"), std::string::npos) << warnings[0];
  std::size_t rejected = 0;
  for (const Loop& loop : joined.loops) {
    const bool wrong = loop.tail.mission == 0 && loop.head.mission == 3;
    EXPECT_EQ(loop.state, wrong ? LoopState::rejected : LoopState::accepted);
    if (loop.state != LoopState::rejected) continue;
    ++rejected;
    EXPECT_NE(loop.reason.find("contradicts the frames that all other loops give"),
              std::string::npos);
  }
  EXPECT_EQ(rejected, 20u);
}

TEST(JoinIslands, FramesAreTheMiddleOfWhatAllPairsSay) {
  // Around a ring the pairs miss closing by 0.4 m: each takes a quarter, none all.
  Atlas atlas = four_missions();
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}})
    tie(atlas, std::uint32_t(a), std::uint32_t(b), 20);
  tie(atlas, 0, 3, 20, SE3::from_yaw(0, {0, 0, 0.4}));
  const Atlas joined = join(atlas);
  // A loop to `d`, 0.4 m too high: d rises by three quarters of what would close it.
  for (std::uint32_t m = 0; m < 4; ++m)
    EXPECT_NEAR(joined.T_map_node({m, 10}).t.z(), 0.1 * m, 1e-6) << m;
}

TEST(JoinIslands, APairThatAloneHoldsAMissionIsUsedWhateverItSays) {
  Atlas atlas = four_missions();
  tie(atlas, 0, 1, 20);
  tie(atlas, 1, 2, 20);
  tie(atlas, 0, 2, 5, SE3::from_yaw(1, {80, 0, 0}));
  tie(atlas, 2, 3, 1);
  std::vector<std::string> warnings;
  const Atlas joined = join_islands(atlas, [&](const std::string& w) { warnings.push_back(w); });
  EXPECT_EQ(joined.islands.size(), 1u);
  EXPECT_LT(furthest_apart(joined), 1e-6);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("between 'a' and 'c'"), std::string::npos) << warnings[0];
}

TEST(JoinIslands, ThreePairsThatContradictEachOtherStillGiveAMap) {
  // No majority: the heavier pairs stay, and the lighter one is named.
  Atlas atlas = four_missions();
  tie(atlas, 0, 1, 12);
  tie(atlas, 1, 2, 20);
  tie(atlas, 2, 3, 20);
  tie(atlas, 0, 2, 10, SE3::from_yaw(0, {50, 0, 0}));
  std::vector<std::string> warnings;
  const Atlas joined = join_islands(atlas, [&](const std::string& w) { warnings.push_back(w); });
  EXPECT_EQ(joined.islands.size(), 1u);
  EXPECT_LT(furthest_apart(joined), 1e-6);
  ASSERT_EQ(warnings.size(), 1u);
}

TEST(JoinIslands, ALoopThatCannotSeeTheContradictionIsNotRejected) {
  Atlas atlas = four_missions();
  tie(atlas, 0, 1, 20);
  tie(atlas, 1, 2, 20);
  tie(atlas, 2, 3, 20);
  tie(atlas, 0, 2, 5, SE3::from_yaw(0, {0, 0, 30}));
  for (Loop& loop : atlas.loops) {
    Mat6 information = 100 * Mat6::Identity();
    if (loop.T_tail_head.t.z() > 1) information(2, 2) = 1e-4;  // its height is a guess
    loop.information = information;
  }
  const Atlas joined = join_islands(atlas, [](const std::string&) {});
  EXPECT_LT(furthest_apart(joined), 1e-6);
  for (const Loop& loop : joined.loops) EXPECT_EQ(loop.state, LoopState::accepted);
}
