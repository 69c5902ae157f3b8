// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>

#include "support/maps.hpp"

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
    write_truth(make_atlas({missions_.back()}), folder_.path(), T_world_map_);
  }

  Atlas atlas() const { return tied(islands()); }
  Atlas islands() const { return make_atlas(missions_); }

  std::map<std::string, double> ate(const Atlas& atlas, const std::string& yaml = "{}") const {
    return evaluate("ate", atlas, folder_.path(), yaml);
  }

  TemporaryFolder folder_;
  SE3 T_world_map_ = far_away();
  std::vector<Mission> missions_;
};

TEST_F(Ate, IsZeroForAMapThatIsOnlyPlacedElsewhere) {
  add_mission("a", circle(12, 10));
  add_mission("b", circle(7, 5));
  const auto m = ate(atlas());
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
  auto poses = *bent.missions[0].T_map_node;
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i].t.z() += i % 2 ? 0.25 : -0.25;
  bent.missions[0].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  const auto m = ate(bent);
  for (const char* name : {"ate.rmse", "ate.median", "ate.max", "ate.a.rmse", "ate.a.own.rmse"})
    EXPECT_NEAR(m.at(name), 0.25, 1e-9) << name;
}

// Two equal missions, one shifted by d: the joint alignment takes the mean, each is off by d / 2.
TEST_F(Ate, OneAlignmentForAllMissionsSeesThatOneIsShifted) {
  add_mission("a", circle(10, 10));
  add_mission("b", circle(10, 10));
  const auto m = ate(moved(atlas(), 1, SE3::from_yaw(0, {0, 0, 0.6})));
  EXPECT_NEAR(m.at("ate.rmse"), 0.3, 1e-9);
  EXPECT_NEAR(m.at("ate.b.rmse"), 0.3, 1e-9);
  EXPECT_LT(m.at("ate.b.own.rmse"), 1e-9);
}

// A tilt about x lifts a point of a circle of radius r by up to r sin(tilt).
TEST_F(Ate, YawDoesNotUndoATiltAndSe3Does) {
  add_mission("a", circle(16, 10));
  Vec6 tilt = Vec6::Zero();
  tilt[3] = 0.05;
  const Atlas tilted = moved(atlas(), 0, SE3::exp(tilt));
  EXPECT_NEAR(ate(tilted).at("ate.max"), 10 * std::hypot(std::sin(0.05), 1 - std::cos(0.05)), 0.01);
  EXPECT_LT(ate(tilted, "{alignment: se3}").at("ate.rmse"), 1e-9);
}

TEST_F(Ate, NoAlignmentComparesFramesAsTheyAre) {
  T_world_map_ = SE3::from_yaw(0, {3, 4, 0});
  add_mission("a", circle(8, 10));
  const auto m = ate(atlas(), "{alignment: none}");
  EXPECT_NEAR(m.at("ate.rmse"), 5, 1e-9);
  EXPECT_NEAR(m.at("ate.a.own.rmse"), 5, 1e-9);
}

TEST_F(Ate, TheLargestIslandIsTheMapAndTheRestIsCounted) {
  add_mission("a", circle(5, 10));
  add_mission("b", circle(9, 10));
  const auto m = ate(islands());
  EXPECT_EQ(m.at("ate.nodes"), 9);
  EXPECT_EQ(m.at("ate.nodes_outside"), 5);
  EXPECT_EQ(m.at("ate.islands"), 2);
  EXPECT_LT(m.at("ate.island_0.rmse"), 1e-9);
}

TEST_F(Ate, NeedsSomeTruth) {
  missions_.push_back(make_mission("a", circle(5, 10)));
  EXPECT_THROW(ate(atlas()), Error);
  add_mission("b", circle(5, 10));
  EXPECT_EQ(ate(atlas()).count("ate.a.rmse"), 0u);
}

}  // namespace
}  // namespace cambium::testing
