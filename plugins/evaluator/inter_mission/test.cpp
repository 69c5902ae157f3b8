// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "support/maps.hpp"

namespace cambium::testing {
namespace {

/// Two lanes 6 m apart, ten nodes 8 m apart in each: a node has one of the other mission at 6 m and
/// two at hypot(6, 8) = 10 m.
class InterMissionError : public ::testing::Test {
 protected:
  InterMissionError() {
    std::vector<Mission> missions;
    for (const char* name : {"a", "b"}) {
      std::vector<SE3> poses;
      for (int i = 0; i < 10; ++i)
        poses.push_back(SE3::from_yaw(0.3 * i, {8.0 * i, *name == 'a' ? 0.0 : 6.0, 0}));
      missions.push_back(make_mission(name, poses));
    }
    atlas_ = tied(make_atlas(missions));
    write_truth(atlas_, folder_.path());
  }

  std::map<std::string, double> errors(const Atlas& atlas, const std::string& yaml = "{}") const {
    return evaluate("inter_mission", atlas, folder_.path(), yaml);
  }

  TemporaryFolder folder_;
  Atlas atlas_;
};

TEST_F(InterMissionError, IsZeroForATrueMapWhereverItLies) {
  const SE3 T = SE3::from_yaw(2, {50, 60, 7});
  const auto m = errors(moved(moved(atlas_, 0, T), 1, T), "{max_distance: 9.9}");
  EXPECT_LT(m.at("inter_mission.translation"), 1e-9);
  EXPECT_LT(m.at("inter_mission.rotation"), 1e-6);
  EXPECT_EQ(m.at("inter_mission.pairs"), 10);
}

// A mission that is shifted by d is off by d in every pair, whatever the nodes' headings.
TEST_F(InterMissionError, MeasuresAKnownShift) {
  const auto m = errors(moved(atlas_, 1, SE3::from_yaw(0, {0.3, -0.4, 1.2})));
  EXPECT_NEAR(m.at("inter_mission.translation"), 1.3, 1e-9);
  EXPECT_NEAR(m.at("inter_mission.a.b.translation"), 1.3, 1e-9);
  EXPECT_LT(m.at("inter_mission.rotation"), 1e-6);
}

TEST_F(InterMissionError, MeasuresAKnownTurn) {
  // Every node of b turns on the spot.
  Atlas turned = atlas_;
  auto poses = *turned.missions[1].T_map_node;
  for (SE3& T : poses) T = T * SE3::from_yaw(2 * M_PI / 180);
  turned.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  const auto m = errors(turned);
  EXPECT_NEAR(m.at("inter_mission.rotation"), 2, 1e-9);
  EXPECT_LT(m.at("inter_mission.translation"), 1e-9);
}

TEST_F(InterMissionError, TakesPairsThatAreTrulyNear) {
  EXPECT_EQ(errors(atlas_, "{max_distance: 10.001}").at("inter_mission.pairs"), 10 + 18);
  EXPECT_EQ(errors(atlas_, "{max_distance: 5.9}").at("inter_mission.pairs"), 0);
  const Atlas apart =
      moved(atlas_, 1, SE3::from_yaw(0, {1000, 0, 0}));  // by the truth, not the map
  EXPECT_EQ(errors(apart, "{max_distance: 7}").at("inter_mission.pairs"), 10);
}

TEST_F(InterMissionError, CountsPairsThatTheMapDoesNotTie) {
  Atlas islands = atlas_;
  islands.islands = {{{0}, {}}, {{1}, {}}};
  islands.missions[1].island = 1;
  const auto m = errors(islands, "{max_distance: 7}");
  EXPECT_EQ(m.at("inter_mission.untied_pairs"), 10);
  EXPECT_EQ(m.at("inter_mission.pairs"), 0);
  EXPECT_EQ(m.count("inter_mission.translation"), 0u);
}

TEST_F(InterMissionError, NeedsTruth) {
  std::filesystem::remove(folder_ / "a.tum");
  EXPECT_EQ(errors(atlas_).at("inter_mission.pairs"), 0);
  std::filesystem::remove(folder_ / "b.tum");
  EXPECT_THROW(errors(atlas_), Error);
}

}  // namespace
}  // namespace cambium::testing
