// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

TEST(TumExporter, WritesOneTrajectoryPerMissionInTheMapFrame) {
  const TemporaryFolder folder;
  Mission b = make_mission("b", {SE3{}, SE3::from_yaw(0.2, {1.0 / 3, 0, 0})});
  b.nodes[1].stamp = Stamp{1583840261, 39995392};
  Atlas atlas = make_atlas({make_mission("a", {SE3{}}), b});
  const SE3 T_map_b = SE3::from_yaw(0.7, {1e5, 2, 3});
  const std::vector<SE3> poses{T_map_b, T_map_b * b.nodes[1].T_mission_node};
  atlas.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  const auto files = component<MapExporter>("tum")->write(atlas, folder.path(), *make_context());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1], folder / "b.tum");
  const auto back = read_tum(files[1]);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[1].stamp, *b.nodes[1].stamp);
  EXPECT_EQ(back[1].T_map_node.t, poses[1].t);
}

TEST(TumExporter, NodesWithoutAStampHaveNoRow) {
  const TemporaryFolder folder;
  Mission a = make_mission("a", {SE3{}, SE3{}, SE3{}});
  a.nodes[0].stamp.reset();
  const auto files =
      component<MapExporter>("tum")->write(make_atlas({a}), folder.path(), *make_context());
  EXPECT_EQ(read_tum(files[0]).size(), 2u);
}

}  // namespace
}  // namespace cambium::testing
