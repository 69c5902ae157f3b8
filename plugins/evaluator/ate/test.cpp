// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

std::vector<SE3> circle(int n, double radius) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    poses.push_back(SE3::from_yaw(angle, {radius * std::cos(angle), radius * std::sin(angle), 0}));
  }
  return poses;
}

/// The truth of each mission is T_world_map times its poses; the map is what the test makes of it.
class Ate : public ::testing::Test {
 protected:
  void add_mission(const std::string& name, const std::vector<SE3>& poses) {
    missions_.push_back(make_mission(name, poses));
    std::vector<StampedPose> rows;
    for (const Node& node : missions_.back().nodes)
      rows.push_back({*node.stamp, T_world_map_ * node.T_mission_node});
    write_file(folder_ / (name + ".tum"), format_tum(rows));
  }

  Atlas atlas(bool tied = true) const {
    Atlas out = make_atlas(missions_);
    if (!tied) return out;
    out.islands = {Island{}};
    for (std::uint32_t m = 0; m < out.missions.size(); ++m) {
      out.islands[0].missions.push_back(m);
      out.missions[m].island = 0;
    }
    return out;
  }

  template <class Change>
  static void change(Atlas& atlas, std::uint32_t mission, Change change) {
    auto poses = *atlas.missions[mission].T_map_node;
    for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = change(poses[i], i);
    atlas.missions[mission].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  }

  std::map<std::string, double> evaluate(const Atlas& atlas, const std::string& yaml = "{}") const {
    std::map<std::string, double> out;
    for (const Metric& m :
         component<Evaluator>("ate", yaml)->evaluate(atlas, folder_.path(), *make_context()))
      EXPECT_TRUE(out.emplace(m.name, m.value).second) << m.name << " twice";
    return out;
  }

  TemporaryFolder folder_;
  SE3 T_world_map_ = SE3::from_yaw(1.3, {100, -200, 5});
  std::vector<Mission> missions_;
};

TEST_F(Ate, IsZeroForAMapThatIsOnlyPlacedElsewhere) {
  add_mission("a", circle(12, 10));
  add_mission("b", circle(7, 5));
  const auto m = evaluate(atlas());
  EXPECT_LT(m.at("ate.rmse"), 1e-9);
  EXPECT_LT(m.at("ate.max"), 1e-9);
  EXPECT_LT(m.at("ate.b.own.rmse"), 1e-9);
  EXPECT_EQ(m.at("ate.nodes"), 19);
  EXPECT_EQ(m.at("ate.islands"), 1);
}

// Up and down by d in turn: no yaw or translation undoes it, so every error is d.
TEST_F(Ate, MeasuresAKnownBend) {
  add_mission("a", circle(12, 10));
  Atlas bent = atlas();
  change(bent, 0, [](SE3 T, std::size_t i) {
    T.t.z() += i % 2 ? 0.25 : -0.25;
    return T;
  });
  const auto m = evaluate(bent);
  for (const char* name : {"ate.rmse", "ate.median", "ate.max", "ate.a.rmse", "ate.a.own.rmse"})
    EXPECT_NEAR(m.at(name), 0.25, 1e-9) << name;
}

// Two equal missions, one shifted by d: the joint alignment takes the mean, each is off by d / 2.
TEST_F(Ate, OneAlignmentForAllMissionsSeesThatOneIsShifted) {
  add_mission("a", circle(10, 10));
  add_mission("b", circle(10, 10));
  Atlas shifted = atlas();
  change(shifted, 1, [](SE3 T, std::size_t) {
    T.t.z() += 0.6;
    return T;
  });
  const auto m = evaluate(shifted);
  EXPECT_NEAR(m.at("ate.rmse"), 0.3, 1e-9);
  EXPECT_NEAR(m.at("ate.b.rmse"), 0.3, 1e-9);
  EXPECT_LT(m.at("ate.b.own.rmse"), 1e-9);
}

// A tilt about x lifts a point of a circle of radius r by up to r sin(tilt).
TEST_F(Ate, YawDoesNotUndoATiltAndSe3Does) {
  add_mission("a", circle(16, 10));
  Atlas tilted = atlas();
  Vec6 tilt = Vec6::Zero();
  tilt[3] = 0.05;
  change(tilted, 0, [&](const SE3& T, std::size_t) { return SE3::exp(tilt) * T; });
  EXPECT_NEAR(evaluate(tilted).at("ate.max"), 10 * std::hypot(std::sin(0.05), 1 - std::cos(0.05)),
              0.01);
  EXPECT_LT(evaluate(tilted, "{alignment: se3}").at("ate.rmse"), 1e-9);
}

TEST_F(Ate, NoAlignmentComparesFramesAsTheyAre) {
  T_world_map_ = SE3::from_yaw(0, {3, 4, 0});
  add_mission("a", circle(8, 10));
  const auto m = evaluate(atlas(), "{alignment: none}");
  EXPECT_NEAR(m.at("ate.rmse"), 5, 1e-9);
  EXPECT_NEAR(m.at("ate.a.own.rmse"), 5, 1e-9);
}

TEST_F(Ate, TheLargestIslandIsTheMapAndTheRestIsCounted) {
  add_mission("a", circle(5, 10));
  add_mission("b", circle(9, 10));
  const auto m = evaluate(atlas(false));
  EXPECT_EQ(m.at("ate.nodes"), 9);
  EXPECT_EQ(m.at("ate.nodes_outside"), 5);
  EXPECT_EQ(m.at("ate.islands"), 2);
  EXPECT_LT(m.at("ate.island_0.rmse"), 1e-9);
}

TEST_F(Ate, NeedsSomeTruth) {
  missions_.push_back(make_mission("a", circle(5, 10)));
  EXPECT_THROW(evaluate(atlas()), Error);
  add_mission("b", circle(5, 10));
  EXPECT_EQ(evaluate(atlas()).count("ate.a.rmse"), 0u);
}

}  // namespace
}  // namespace cambium::testing
