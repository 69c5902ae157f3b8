// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

Vec6 noise(std::mt19937_64& engine, double sigma_t, double sigma_r) {
  std::normal_distribution<double> normal;
  Vec6 xi;
  for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? sigma_t : sigma_r) * normal(engine);
  return xi;
}

/// Two missions over the same winding path of one-metre steps, the second in a frame of its own and
/// walked the other way round. Odometry that is 1 % long and turns.
class World {
 public:
  explicit World(std::size_t nodes, double scale_error = 0.01) {
    for (std::size_t i = 0; i < nodes; ++i) {
      const double s = double(i);
      truth_.push_back(SE3::from_yaw(0.02 * s + 0.5 * std::sin(0.1 * s)));
      if (i > 0) truth_[i].t = truth_[i - 1].t + truth_[i - 1].q * Vec3(1, 0, 0.02);
    }
    std::vector<SE3> there = drifted(truth_, scale_error, 1e-4);
    const auto back = drifted({truth_.rbegin(), truth_.rend()}, -scale_error, -1e-4);
    atlas = make_atlas({make_mission("mission_a", there), make_mission("mission_b", back)});
  }

  /// Node of mission_b at the place of node i of mission_a.
  std::uint32_t twin(std::size_t i) const { return std::uint32_t(truth_.size() - 1 - i); }

  void add_true(std::size_t a, std::uint32_t b) {
    const SE3 T = truth_[a].inverse() * truth_[truth_.size() - 1 - b];
    add({0, std::uint32_t(a)}, {1, b}, T * SE3::exp(noise(engine, 0.05, 0.005)));
    is_true.push_back(true);
  }

  void add_false(NodeRef tail, NodeRef head, const SE3& T) {
    add(tail, head, T);
    is_true.push_back(false);
  }

  void add_random() {
    const NodeRef tail{0, std::uint32_t(engine() % truth_.size())};
    const NodeRef head{1, std::uint32_t(engine() % truth_.size())};
    add_false(tail, head,
              SE3::from_yaw(std::uniform_real_distribution(-3.1, 3.1)(engine)) *
                  SE3::exp(noise(engine, 2, 0.02)));
  }

  void add(NodeRef tail, NodeRef head, const SE3& T) {
    Loop loop;
    loop.tail = tail, loop.head = head;
    loop.state = LoopState::registered;
    loop.T_tail_head = T;
    loop.information = Mat6::Identity() / (0.05 * 0.05);
    loop.information.bottomRightCorner<3, 3>() = Mat3::Identity() / (0.01 * 0.01);
    atlas.loops.push_back(loop);
  }

  Atlas atlas;
  std::vector<bool> is_true;
  std::mt19937_64 engine{17};

 private:
  static std::vector<SE3> drifted(const std::vector<SE3>& path, double scale, double turn) {
    std::vector<SE3> out{SE3{}};
    for (std::size_t i = 1; i < path.size(); ++i) {
      SE3 step = path[i - 1].inverse() * path[i];
      step.t *= 1 + scale;
      out.push_back(out.back() * step * SE3::from_yaw(turn));
    }
    return out;
  }

  std::vector<SE3> truth_;
};

std::vector<Verdict> verify(const Atlas& atlas, const std::string& yaml = "{}",
                            std::vector<std::size_t> order = {}, int threads = 1) {
  if (order.empty()) {
    order.resize(atlas.loops.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
  }
  const auto context = make_context(threads);
  return component<LoopVerifier>("pairwise_consistency", yaml)->verify(atlas, order, *context);
}

struct Count {
  std::size_t true_accepted = 0, false_accepted = 0, trues = 0;
};

Count count(const std::vector<Verdict>& verdicts, const std::vector<bool>& is_true) {
  Count c;
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    EXPECT_FALSE(verdicts[i].reason.empty());
    c.trues += is_true[i];
    (is_true[i] ? c.true_accepted : c.false_accepted) += verdicts[i].accepted;
  }
  return c;
}

/// 30 true loops, 18 random false ones, and 12 that agree on one wrong place.
World half_false() {
  World world(200);
  for (std::size_t k = 0; k < 30; ++k) world.add_true(10 + 6 * k, world.twin(10 + 6 * k));
  for (int k = 0; k < 18; ++k) world.add_random();
  const SE3 T_wrong = SE3::from_yaw(0.7, Vec3(3, -2, 0));
  const auto& a = *world.atlas.missions[0].T_map_node;
  const auto& b = *world.atlas.missions[1].T_map_node;
  for (std::uint32_t k = 0; k < 12; ++k)  // T_a_b = a[100] T_wrong b[40]^-1 for all of them
    world.add_false({0, 100 + k}, {1, 40 + k},
                    (a[100 + k].inverse() * a[100]) * T_wrong * (b[40].inverse() * b[40 + k]));
  return world;
}

TEST(PairwiseConsistency, KeepsTheTrueLoopsOfHalfFalseOnes) {
  const World world = half_false();
  const auto verdicts = verify(world.atlas);
  const Count c = count(verdicts, world.is_true);
  EXPECT_EQ(c.false_accepted, 0u);
  EXPECT_GE(c.true_accepted, 28u);
  EXPECT_NE(verdicts[0].reason.find("of 59 other loops between mission_a and mission_b"),
            std::string::npos)
      << verdicts[0].reason;
  const std::string& why = verdicts.back().reason;
  EXPECT_NE(why.find("contradicts loop "), std::string::npos) << why;
  EXPECT_NE(why.find("sigma (largest clique: "), std::string::npos) << why;
}

TEST(PairwiseConsistency, DoesNotDependOnTheOrderNorTheThreads) {
  const World world = half_false();
  const auto expected = verify(world.atlas);
  std::vector<std::size_t> order(world.atlas.loops.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 engine(2);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(order.begin(), order.end(), engine);
    const auto verdicts = verify(world.atlas, "{}", order, 1 + round);
    for (std::size_t k = 0; k < order.size(); ++k) {
      EXPECT_EQ(verdicts[k].accepted, expected[order[k]].accepted);
      EXPECT_EQ(verdicts[k].reason, expected[order[k]].reason);
    }
  }
}

TEST(PairwiseConsistency, DoesNotDependOnThePositionInTheAtlas) {
  const World world = half_false();
  const auto expected = verify(world.atlas);
  Atlas turned = world.atlas;
  std::reverse(turned.loops.begin(), turned.loops.end());
  const auto verdicts = verify(turned);
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_EQ(verdicts[k].reason, expected[expected.size() - 1 - k].reason);
}

TEST(PairwiseConsistency, FindsOneInTenOfAThousandLoops) {
  World world(500);
  for (std::size_t k = 0; k < 100; ++k) world.add_true(5 * k, world.twin(5 * k));
  for (int k = 0; k < 900; ++k) world.add_random();
  const Count c = count(verify(world.atlas), world.is_true);
  EXPECT_LE(c.false_accepted, 2u);  // a random transform may be right by chance
  EXPECT_GE(c.true_accepted, 92u);
}

TEST(PairwiseConsistency, ToleratesTwoPercentOfDrift) {
  World world(600, 0.02);
  for (std::size_t k = 0; k < 60; ++k) world.add_true(10 * k, world.twin(10 * k));
  EXPECT_GE(count(verify(world.atlas), world.is_true).true_accepted, 55u);
}

TEST(PairwiseConsistency, TooFewLoopsDoNotTieTwoMissions) {
  World world(100);
  world.add_true(10, world.twin(10));
  auto verdicts = verify(world.atlas);
  EXPECT_FALSE(verdicts[0].accepted);
  EXPECT_NE(verdicts[0].reason.find("only 1 of 1 loops"), std::string::npos) << verdicts[0].reason;
  EXPECT_TRUE(verify(world.atlas, "{min_clique: 1, min_support_path: 0}")[0].accepted);
  world.add_true(40, world.twin(40));
  EXPECT_FALSE(verify(world.atlas)[0].accepted);
  world.add_true(70, world.twin(70));
  verdicts = verify(world.atlas);
  EXPECT_TRUE(verdicts[0].accepted && verdicts[1].accepted && verdicts[2].accepted);
}

TEST(PairwiseConsistency, NeighboursAroundOnePlaceAreNotEnough) {
  World world = half_false();
  World aliased(200);  // more false neighbours around one place than true loops
  const auto& a = *aliased.atlas.missions[0].T_map_node;
  const auto& b = *aliased.atlas.missions[1].T_map_node;
  for (std::uint32_t i = 0; i < 4; ++i)
    for (std::uint32_t j = 0; j < 4; ++j)
      aliased.add_false({0, 100 + i}, {1, 40 + j},
                        (a[100 + i].inverse() * a[100]) * (b[40].inverse() * b[40 + j]));
  for (std::size_t k = 0; k < 8; ++k) aliased.add_true(20 * k + 5, aliased.twin(20 * k + 5));
  const Count with = count(verify(aliased.atlas), aliased.is_true);
  EXPECT_EQ(with.false_accepted, 0u);
  EXPECT_EQ(with.true_accepted, 8u);
  const Count without = count(verify(aliased.atlas, "{min_support_path: 0}"), aliased.is_true);
  EXPECT_EQ(without.false_accepted, 16u);
  EXPECT_NE(verify(aliased.atlas)[0].reason.find("3.0"), std::string::npos)
      << verify(aliased.atlas)[0].reason;
}

/// Two rounds of a 100 m circle with 1 % drift, loops within the mission.
struct TwoRounds {
  TwoRounds() {
    std::vector<SE3> path{SE3{}};
    for (int i = 1; i < 200; ++i)
      path.push_back(path.back() * SE3::from_yaw(2 * std::numbers::pi / 100, Vec3(1.01, 0, 0.01)));
    atlas = make_atlas({make_mission("mission_a", path)});
  }
  void add(std::uint32_t tail, std::uint32_t head, const SE3& T) {
    Loop loop;
    loop.tail = {0, tail}, loop.head = {0, head};
    loop.T_tail_head = T;
    loop.information *= 1000;
    atlas.loops.push_back(loop);
  }
  Atlas atlas;
};

// Rows of a plantation: every row further is a set of loops that agree with each other.
TEST(PairwiseConsistency, APlaceThatRepeatsItselfTiesNothing) {
  World world(60, 0);
  const auto& a = *world.atlas.missions[0].T_map_node;
  const auto& b = *world.atlas.missions[1].T_map_node;
  const auto add_row = [&](double shift, std::uint32_t first, std::uint32_t count) {
    for (std::uint32_t k = 0; k < count; ++k) {
      const SE3 T_a_b = a[30] * SE3::from_yaw(0, {0, shift, 0}) * b[30].inverse();
      world.add_false({0, first + 4 * k}, {1, first + 4 * k},
                      a[first + 4 * k].inverse() * T_a_b * b[first + 4 * k]);
    }
  };
  add_row(0, 10, 5);
  EXPECT_EQ(count(verify(world.atlas), world.is_true).false_accepted, 5u);
  add_row(4, 12, 3);
  const auto verdicts = verify(world.atlas);
  EXPECT_EQ(count(verdicts, world.is_true).false_accepted, 0u);
  EXPECT_NE(verdicts[0].reason.find("repeats itself"), std::string::npos) << verdicts[0].reason;
  EXPECT_EQ(count(verify(world.atlas, "{max_rival: 0.7}"), world.is_true).false_accepted, 5u);
}

// Between two stretches of the path the odometry may have slipped: that is no repeating place.
TEST(PairwiseConsistency, ASetOverAnotherStretchIsNoRival) {
  World world(100, 0);
  const auto& a = *world.atlas.missions[0].T_map_node;
  const auto& b = *world.atlas.missions[1].T_map_node;
  const auto add_stretch = [&](double shift, std::uint32_t first, std::uint32_t last) {
    const SE3 T_a_b = a[50] * SE3::from_yaw(0, {0, shift, 0}) * b[50].inverse();
    for (std::uint32_t i = first; i < last; i += 4)
      world.add_false({0, i}, {1, i}, a[i].inverse() * T_a_b * b[i]);
  };
  add_stretch(0, 0, 40);
  add_stretch(15, 60, 96);
  EXPECT_EQ(count(verify(world.atlas), world.is_true).false_accepted, 10u);
}

TEST(PairwiseConsistency, WithinAMissionTheOdometryIsAWitness) {
  TwoRounds world;
  for (std::uint32_t k = 0; k < 20; ++k) world.add(5 * k, 100 + 5 * k, SE3{});
  world.add(10, 60, SE3{});                             // 31.8 m apart
  world.add(20, 120, SE3::from_yaw(0, Vec3(0, 2, 0)));  // 1 m off what the others say
  const auto verdicts = verify(world.atlas);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_TRUE(verdicts[k].accepted) << verdicts[k].reason;
  EXPECT_NE(verdicts[0].reason.find("the odometry and 19 of 21 other loops within mission_a"),
            std::string::npos)
      << verdicts[0].reason;
  EXPECT_FALSE(verdicts[20].accepted);
  EXPECT_NE(verdicts[20].reason.find("contradicts the odometry by "), std::string::npos);
  EXPECT_FALSE(verdicts[21].accepted);
  EXPECT_NE(verdicts[21].reason.find("contradicts loop "), std::string::npos)
      << verdicts[21].reason;
}

TEST(PairwiseConsistency, OneLoopWithinAMissionNeedsASecond) {
  TwoRounds world;
  world.add(10, 110, SE3{});
  EXPECT_FALSE(verify(world.atlas)[0].accepted);
  EXPECT_TRUE(verify(world.atlas, "{min_clique: 2}")[0].accepted);
  world.add(30, 130, SE3{});
  EXPECT_TRUE(verify(world.atlas)[0].accepted);
}

TEST(PairwiseConsistency, PairsOfMissionsAreJudgedApart) {
  World world = half_false();
  const auto expected = verify(world.atlas);
  std::vector<Mission> missions;
  for (const auto& state : world.atlas.missions) missions.push_back(*state.mission);
  missions.push_back(make_mission("mission_c", {SE3{}, SE3::from_yaw(0, Vec3(1, 0, 0))}));
  Atlas three = make_atlas(missions);
  three.loops = world.atlas.loops;
  Loop stray;
  stray.tail = {0, 3}, stray.head = {2, 1};
  three.loops.push_back(stray);
  const auto verdicts = verify(three);
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_EQ(verdicts[k].reason, expected[k].reason);
  EXPECT_FALSE(verdicts.back().accepted);
}

/// The same missions with odometry edges that are absent, or say nothing (identity information).
TEST(PairwiseConsistency, OdometryWithoutInformationStillTellsFalseFromTrue) {
  const World world = half_false();
  for (const bool absent : {true, false}) {
    Atlas atlas = world.atlas;
    for (auto& state : atlas.missions) {
      Mission mission = *state.mission;
      if (absent) mission.edges.clear();
      for (Edge& e : mission.edges) e.information = Mat6::Identity();
      state.mission = std::make_shared<const Mission>(mission);
    }
    const Count c = count(verify(atlas), world.is_true);
    EXPECT_EQ(c.false_accepted, 0u) << absent;
    EXPECT_GE(c.true_accepted, 28u) << absent;
  }
}

TEST(PairwiseConsistency, ReversedOdometryEdgesSayTheSame) {
  const World world = half_false();
  Atlas atlas = world.atlas;
  for (auto& state : atlas.missions) {
    Mission mission = *state.mission;
    for (Edge& e : mission.edges) {
      std::swap(e.tail, e.head);
      e.T_tail_head = e.T_tail_head.inverse();
    }
    state.mission = std::make_shared<const Mission>(mission);
  }
  const auto expected = verify(world.atlas), verdicts = verify(atlas);
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_EQ(verdicts[k].accepted, expected[k].accepted) << k;
}

TEST(PairwiseConsistency, LoopsThatAreNotFiniteAreRejectedAlone) {
  World world = half_false();
  world.atlas.loops[3].T_tail_head.t.x() = std::nan("");
  world.atlas.loops[4].information(0, 0) = std::nan("");
  const auto verdicts = verify(world.atlas);
  for (const int k : {3, 4}) {
    EXPECT_FALSE(verdicts[k].accepted);
    EXPECT_NE(verdicts[k].reason.find("not finite"), std::string::npos) << verdicts[k].reason;
  }
  EXPECT_GE(count(verdicts, world.is_true).true_accepted, 26u);
}

TEST(PairwiseConsistency, ABranchLimitGivesTheBestSoFarTheSameEachTime) {
  const World world = half_false();
  const auto a = verify(world.atlas, "{branch_limit: 1}"),
             b = verify(world.atlas, "{branch_limit: 1}");
  for (std::size_t k = 0; k < a.size(); ++k) EXPECT_EQ(a[k].reason, b[k].reason);
  EXPECT_GE(count(a, world.is_true).true_accepted, 20u);
}

TEST(PairwiseConsistency, NoLoopsNoVerdicts) { EXPECT_TRUE(verify(World(10).atlas).empty()); }

}  // namespace
}  // namespace cambium::testing
