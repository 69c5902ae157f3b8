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

std::set<std::uint32_t> found(const Atlas& atlas, std::vector<std::string>& warnings) {
  return not_level(atlas, atlas.islands[0], 0.1,
                   [&](const std::string& text) { warnings.push_back(text); });
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
