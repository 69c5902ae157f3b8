// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/fused.hpp"

#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/geodesy.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

std::vector<SE3> straight(int n) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) poses.push_back(SE3::from_yaw(0.1 * i, {double(i), 0.5 * i, 0.1}));
  return poses;
}

std::vector<SE3> moved(const SE3& T, std::vector<SE3> poses) {
  for (SE3& pose : poses) pose = T * pose;
  return poses;
}

/// Two missions of 4 and 3 nodes in one island; b lies at T_map_b and is tied to a by two loops,
/// of which one was rejected.
Atlas tied_atlas(const SE3& T_map_b) {
  Mission a = make_mission("a", straight(4)), b = make_mission("b", straight(3));
  a.platform_id = 1;
  b.platform_id = 2;
  a.nodes[0].fixed = b.nodes[0].fixed = true;
  b.unknown_lines = {{3, "TAG_POSE 7 1 2 3"}, {4, "# walked by hand"}};
  Atlas atlas = make_atlas({a, b});
  atlas.islands = {{{0, 1}, {}}};
  atlas.missions[1].island = 0;
  atlas.missions[1].id_offset = 10000;
  atlas.missions[1].T_map_node =
      std::make_shared<const std::vector<SE3>>(moved(T_map_b, straight(3)));
  Loop loop{.tail = {0, 2}, .head = {1, 1}, .state = LoopState::accepted};
  loop.weight = 0.25;
  atlas.loops = {loop, {.tail = {0, 3}, .head = {1, 2}, .state = LoopState::rejected}};
  return atlas;
}

bool has_line(const Mission& mission, const std::string& text) {
  for (const RawLine& raw : mission.unknown_lines)
    if (raw.text == text) return true;
  return false;
}

TEST(FusedMission, HoldsAllNodesAtTheirMapPoses) {
  const Atlas atlas = tied_atlas(SE3::from_yaw(1.0, {5, 6, 7}));
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  ASSERT_EQ(fused.nodes.size(), 7u);
  ASSERT_TRUE(fused.index_of(10002));
  EXPECT_EQ(fused.nodes[*fused.index_of(10002)].T_mission_node.t, atlas.T_map_node({1, 2}).t);
  EXPECT_EQ(fused.nodes[6].stamp, atlas.node({1, 2}).stamp);
}

TEST(FusedMission, HoldsAllEdgesAndTheAcceptedLoops) {
  const Atlas atlas = tied_atlas({});
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  ASSERT_EQ(fused.edges.size(), 3u + 2u + 1u);
  EXPECT_EQ(fused.edges[3].tail, 10000);
  EXPECT_EQ(fused.edges[5].tail, 2);
  EXPECT_EQ(fused.edges[5].head, 10001);
  EXPECT_EQ(fused.edges[5].kind, EdgeKind::loop);
  EXPECT_TRUE(has_line(fused, "# LOOP_WEIGHT 2 10001 0.25"));
}

TEST(FusedMission, NamesInCommentsWhatAJointFileCannotSay) {
  const Atlas atlas = tied_atlas({});
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  EXPECT_TRUE(fused.nodes[0].fixed);
  EXPECT_FALSE(fused.nodes[4].fixed);
  EXPECT_EQ(fused.platform_id, 0);
  for (const char* line : {"# MISSION a PLATFORM_ID 1 ID_OFFSET 0 NODES 4",
                           "# MISSION b PLATFORM_ID 2 ID_OFFSET 10000 NODES 3", "# b: FIX 10000",
                           "# b: TAG_POSE 7 1 2 3", "# b: walked by hand"})
    EXPECT_TRUE(has_line(fused, line)) << line;
}

TEST(FusedMission, KeepsThePriorsOfTheMissionWhoseFrameIsTheMap) {
  Atlas atlas = tied_atlas(SE3::from_yaw(0.8, {5, 6, 7}));
  for (MissionState& state : atlas.missions) {
    Mission mission = *state.mission;
    Edge prior{.kind = EdgeKind::prior, .tail = 1, .head = 1};
    prior.T_tail_head = SE3::from_yaw(0, {1, 2, 3});
    mission.edges.push_back(prior);
    state.mission = std::make_shared<const Mission>(mission);
  }
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  ASSERT_EQ(fused.edges.size(), 3u + 1u + 2u + 1u);
  EXPECT_EQ(fused.edges[3].kind, EdgeKind::prior);
  EXPECT_EQ(fused.edges[3].tail, 1);
  EXPECT_EQ(fused.edges[3].T_tail_head.t, Vec3(1, 2, 3));
  EXPECT_TRUE(has_line(fused,
                       "# b: EDGE_SE3:QUAT 10001 10001 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 "
                       "0 0 1 0 0 1 0 1"));
}

TEST(FusedMission, CarriesTheGeoreferenceOfAMission) {
  const SE3 T_map_b = SE3::from_yaw(0.8, {5, 6, 7});
  Atlas atlas = tied_atlas(T_map_b);
  EXPECT_FALSE(georeference(atlas, atlas.islands[0]));
  Mission b = *atlas.missions[1].mission;
  b.georeference = GeoReference{61, 25, 100, SE3::from_yaw(0.2, {1, 2, 3}), 0, 0};
  atlas.missions[1].mission = std::make_shared<const Mission>(b);
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  ASSERT_TRUE(fused.georeference);
  const Vec3 p_b(4, 5, 6);
  const Geodetic own = map_to_geodetic(*b.georeference, p_b);
  const Geodetic through_map = map_to_geodetic(*fused.georeference, T_map_b * p_b);
  EXPECT_NEAR(own.latitude, through_map.latitude, 1e-12);
  EXPECT_NEAR(own.longitude, through_map.longitude, 1e-12);
  EXPECT_TRUE(has_line(fused, "# b: GNSS_LLA_REF 61 25 100"));

  atlas.islands[0].georeference = GeoReference{1, 2, 3, {}, 0, 0};
  EXPECT_EQ(fused_mission(atlas, atlas.islands[0]).georeference->latitude, 1);
}

TEST(FusedMission, ReadsBackFromItsFile) {
  const Atlas atlas = tied_atlas(SE3::from_yaw(1.0 / 3, {0.1, 0.2, 0.3}));
  const Mission fused = fused_mission(atlas, atlas.islands[0]);
  std::ostringstream first, second;
  write_g2o(first, fused);
  const Mission back = parse_g2o(first.str(), "fused.g2o");
  write_g2o(second, back);
  EXPECT_EQ(first.str(), second.str());
  EXPECT_EQ(back.nodes.size(), fused.nodes.size());
  EXPECT_EQ(back.edges.size(), fused.edges.size());
}

TEST(FusedMission, RefusesIdsThatCollide) {
  Atlas atlas = tied_atlas({});
  atlas.missions[1].id_offset = 3;
  EXPECT_THROW(fused_mission(atlas, atlas.islands[0]), Error);
}

TEST(Trajectory, LeavesOutNodesWithoutAStamp) {
  Mission a = make_mission("a", straight(4));
  a.nodes[1].stamp.reset();
  const Atlas atlas = make_atlas({a});
  const auto poses = trajectory(atlas.missions[0]);
  ASSERT_EQ(poses.size(), 3u);
  EXPECT_EQ(poses[1].stamp, *a.nodes[2].stamp);
  EXPECT_EQ(poses[1].T_map_node.t, a.nodes[2].T_mission_node.t);
}

TEST(IslandFile, NumbersAllButTheFirst) {
  EXPECT_EQ(island_file("fused", 0, ".g2o"), "fused.g2o");
  EXPECT_EQ(island_file("fused", 2, ".g2o"), "fused_island_2.g2o");
}

}  // namespace
}  // namespace cambium::testing
