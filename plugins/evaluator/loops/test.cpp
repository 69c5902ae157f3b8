// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>

#include "support/maps.hpp"

namespace cambium::testing {
namespace {

/// Two lanes 1 m apart, nodes 4 m apart, ten in each. The truth is turned against the missions.
class Loops : public ::testing::Test {
 protected:
  Loops() {
    std::vector<Mission> missions;
    for (const char* name : {"a", "b"}) {
      std::vector<SE3> poses;
      for (int i = 0; i < 10; ++i)
        poses.push_back(SE3::from_yaw(0.1 * i, {4.0 * i, *name == 'a' ? 0.0 : 1.0, 0}));
      missions.push_back(make_mission(name, poses));
    }
    atlas_ = make_atlas(missions);
    write_truth(atlas_, folder_.path());
  }

  void add_loop(std::uint32_t tail, std::uint32_t head, const SE3& error = {},
                LoopState state = LoopState::accepted) {
    Loop loop{.tail = {0, tail}, .head = {1, head}, .state = state};
    loop.T_tail_head = atlas_.node({0, tail}).T_mission_node.inverse() *
                       atlas_.node({1, head}).T_mission_node * error;
    atlas_.loops.push_back(loop);
  }

  std::map<std::string, double> evaluate(const std::string& yaml = "{}") const {
    return testing::evaluate("loops", atlas_, folder_.path(), yaml);
  }

  TemporaryFolder folder_;
  Atlas atlas_;
};

TEST_F(Loops, CountsWhatIsTiedPerBin) {
  // True distance 1 m: 10 pairs; hypot(4, 1) = 4.1 m: 18 pairs; hypot(8, 1) = 8.06 m: 16 pairs.
  for (const std::uint32_t i : {0u, 3u, 4u, 7u}) add_loop(i, i);
  add_loop(0, 1);
  add_loop(0, 2);
  add_loop(5, 5, {}, LoopState::rejected);
  const auto m = evaluate();
  EXPECT_EQ(m.at("loops.accepted"), 6);
  EXPECT_EQ(m.at("loops.precision"), 1);
  EXPECT_EQ(m.at("loops.wrong"), 0);
  EXPECT_DOUBLE_EQ(m.at("loops.recall.0-2"), 4.0 / 10);
  EXPECT_DOUBLE_EQ(m.at("loops.recall.2-5"), 1.0 / 18);
  EXPECT_DOUBLE_EQ(m.at("loops.recall.5-10"), 1.0 / 16);
  EXPECT_DOUBLE_EQ(m.at("loops.recall.10-15"), 0);
  EXPECT_EQ(m.at("loops.tied.a.b"), 6);  // b's 0 3 4 7 1 2
  EXPECT_EQ(m.at("loops.tied.b.a"), 4);  // a's 0 3 4 7
}

TEST_F(Loops, FindsWrongLoops) {
  add_loop(0, 0, SE3::from_yaw(0, {0.49, 0, 0}));
  add_loop(1, 1, SE3::from_yaw(0, {0, 0.51, 0}));
  add_loop(2, 2, SE3::from_yaw(4.9 * M_PI / 180));
  add_loop(3, 3, SE3::from_yaw(-5.1 * M_PI / 180));
  const auto m = evaluate();
  EXPECT_EQ(m.at("loops.wrong"), 2);
  EXPECT_EQ(m.at("loops.precision"), 0.5);
  EXPECT_EQ(m.at("loops.precision.0-2"), 0.5);
  EXPECT_DOUBLE_EQ(m.at("loops.recall.0-2"), 2.0 / 10);  // a wrong loop finds nothing
  EXPECT_NEAR(m.at("loops.worst_translation"), 0.51, 1e-9);
  EXPECT_NEAR(m.at("loops.worst_rotation"), 5.1, 1e-9);
  EXPECT_EQ(evaluate("{max_translation: 1, max_rotation: 10}").at("loops.wrong"), 0);
}

// Loops that are all off by d show d; the map itself does not matter.
TEST_F(Loops, MeasuresAKnownError) {
  for (const std::uint32_t i : {0u, 3u, 7u}) add_loop(i, i, SE3::from_yaw(0, {0, 0.3, 0}));
  atlas_ = moved(tied(atlas_), 1, SE3::from_yaw(1, {9, 9, 9}));
  EXPECT_NEAR(evaluate().at("loops.worst_translation"), 0.3, 1e-9);
  EXPECT_EQ(evaluate().at("loops.precision"), 1);
  EXPECT_EQ(evaluate("{max_translation: 0.29}").at("loops.precision"), 0);
}

TEST_F(Loops, TheSamePairTwiceIsFoundOnce) {
  add_loop(0, 0);
  add_loop(0, 0);
  EXPECT_DOUBLE_EQ(evaluate().at("loops.recall.0-2"), 1.0 / 10);
}

TEST_F(Loops, BinsAreAParameter) {
  add_loop(0, 0);
  const auto m = evaluate("{bins: [0, 1.5]}");
  EXPECT_DOUBLE_EQ(m.at("loops.recall.0-1.5"), 1.0 / 10);
  EXPECT_EQ(m.count("loops.recall.2-5"), 0u);
  EXPECT_FALSE(component<Evaluator>("loops", "{bins: [0, 1]}")->check_params().size());
}

TEST_F(Loops, NoLoopsHaveNoPrecision) {
  const auto m = evaluate();
  EXPECT_EQ(m.at("loops.accepted"), 0);
  EXPECT_EQ(m.count("loops.precision"), 0u);
  EXPECT_EQ(m.at("loops.recall.0-2"), 0);
}

TEST_F(Loops, LoopsWithoutTruthAreNotJudged) {
  add_loop(0, 0);
  std::filesystem::remove(folder_ / "b.tum");
  const auto m = evaluate();
  EXPECT_EQ(m.at("loops.unjudged"), 1);
  EXPECT_EQ(m.count("loops.precision"), 0u);
  std::filesystem::remove(folder_ / "a.tum");
  EXPECT_THROW(evaluate(), Error);
}

}  // namespace
}  // namespace cambium::testing
