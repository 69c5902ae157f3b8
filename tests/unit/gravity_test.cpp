// SPDX-License-Identifier: BSD-3-Clause
#include "engine/gravity.hpp"

#include <numbers>

#include "support/maps.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

std::vector<SE3> level_path(int n) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) poses.push_back(SE3::from_yaw(0.1 * i, {2.0 * i, 0, 0}));
  return poses;
}

/// A mission as it is recorded in a frame that is turned against a level one.
Mission in_frame(const std::string& name, const SE3& T_frame_level, int nodes = 20) {
  std::vector<SE3> poses;
  for (const SE3& T : level_path(nodes)) poses.push_back(T_frame_level * T);
  return make_mission(name, poses);
}

SE3 rolled(double degrees) {
  Vec6 xi = Vec6::Zero();
  xi[3] = degrees * std::numbers::pi / 180;
  return SE3::exp(xi);
}

/// The map has every mission level, whatever its own frame is.
Atlas mapped(std::vector<Mission> missions) {
  Atlas atlas = tied(make_atlas(std::move(missions)));
  for (MissionState& state : atlas.missions)
    state.T_map_node =
        std::make_shared<const std::vector<SE3>>(level_path(int(state.mission->nodes.size())));
  return atlas;
}

std::set<std::uint32_t> found(Atlas atlas, std::vector<std::string>& warnings) {
  return not_level(atlas, 0, 0.1, [&](const std::string& text) { warnings.push_back(text); });
}

}  // namespace

TEST(NotLevel, NamesTheMissionWhoseGravityIsWrong) {
  std::vector<std::string> warnings;
  const Atlas atlas = mapped({in_frame("a", SE3::from_yaw(1)), in_frame("b", rolled(12)),
                              in_frame("c", SE3::from_yaw(2, {5, 6, 7}))});
  EXPECT_EQ(found(atlas, warnings), std::set<std::uint32_t>{1});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("'b' is not level: its vertical is 12.0 deg"), std::string::npos)
      << warnings[0];
}

TEST(NotLevel, FindsFramesOfAnotherKind) {
  std::vector<std::string> warnings;
  EXPECT_EQ(
      found(mapped({in_frame("a", rolled(180)), in_frame("b", {}), in_frame("c", {})}), warnings),
      std::set<std::uint32_t>{0});
  EXPECT_EQ(
      found(mapped({in_frame("a", {}), in_frame("b", {}), in_frame("c", rolled(-90))}), warnings),
      std::set<std::uint32_t>{2});
}

TEST(NotLevel, TwoEqualPartiesAreBothNamed) {
  std::vector<std::string> warnings;
  EXPECT_EQ(found(mapped({in_frame("a", rolled(20)), in_frame("b", {})}), warnings),
            (std::set<std::uint32_t>{0, 1}));
  EXPECT_EQ(warnings.size(), 2u);
}

TEST(NotLevel, LevelMissionsAreQuiet) {
  std::vector<std::string> warnings;
  EXPECT_TRUE(found(mapped({in_frame("a", rolled(2)), in_frame("b", {})}), warnings).empty());
  EXPECT_TRUE(found(mapped({in_frame("a", rolled(50))}), warnings).empty());
  EXPECT_TRUE(warnings.empty());
}

TEST(NotLevel, AFirstMissionThatIsNotLevelDoesNotTiltTheMap) {
  // As join_islands leaves it: everything in the frame of `a`, which leans by 12 degrees.
  Atlas atlas = mapped({in_frame("a", rolled(12)), in_frame("b", {}), in_frame("c", {})});
  for (std::uint32_t m = 0; m < 3; ++m) atlas = moved(std::move(atlas), m, rolled(12));
  atlas.islands[0].georeference = GeoReference{61, 25, 100, rolled(12)};
  atlas.islands[0].positions = {
      {{1, 4}, rolled(12) * Vec3(8, 0, 0), Mat3(Vec3(4, 2, 1).asDiagonal())}};
  const SE3 first = atlas.T_map_node({0, 0});
  std::vector<std::string> warnings;
  const auto wrong =
      not_level(atlas, 0, 0.1, [&](const std::string& text) { warnings.push_back(text); });
  EXPECT_EQ(wrong, std::set<std::uint32_t>{0});
  EXPECT_LT((atlas.T_map_node({0, 0}).t - first.t).norm(), 1e-9);  // it turned about this node
  for (std::uint32_t m = 0; m < 3; ++m)
    for (const SE3& T : *atlas.missions[m].T_map_node)
      EXPECT_NEAR((T.q * Vec3(Vec3::UnitZ())).z(), 1, 1e-12);
  // What has a place in the map moved along.
  EXPECT_NEAR((atlas.islands[0].georeference->T_map_enu.q * Vec3(Vec3::UnitZ())).z(), 1, 1e-12);
  EXPECT_LT((atlas.islands[0].positions[0].t_map - atlas.T_map_node({1, 4}).t).norm(), 1e-9);
  // Once it is level, nothing moves any more.
  const Atlas level = atlas;
  not_level(atlas, 0, 0.1, [](const std::string&) {});
  EXPECT_EQ(atlas.T_map_node({2, 7}).t, level.T_map_node({2, 7}).t);
}
