// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

std::vector<SE3> path(int n) {
  std::vector<SE3> poses;
  for (int i = 0; i < n; ++i) poses.push_back(SE3::from_yaw(0.1 * i, {1.0 / (i + 3), 2.0 * i, 0}));
  return poses;
}

Atlas three_missions() {
  Atlas atlas = make_atlas(
      {make_mission("a", path(4)), make_mission("b", path(3)), make_mission("c", path(2))});
  atlas.islands = {{{0, 1}, GeoReference{61, 25, 100, SE3::from_yaw(0.1, {1, 2, 3}), 0, 0}},
                   {{2}, {}}};
  atlas.missions[1].island = 0;
  atlas.missions[2].island = 1;
  Loop loop{.tail = {0, 1}, .head = {1, 2}, .state = LoopState::accepted};
  loop.T_tail_head = SE3::from_yaw(1.0 / 7, {0.1, 0.2, 0.3});
  atlas.loops = {loop};
  return atlas;
}

auto write(const Atlas& atlas, const std::filesystem::path& folder) {
  return component<MapExporter>("g2o")->write(atlas, folder, *make_context());
}

TEST(G2oExporter, WritesOneGraphPerIsland) {
  const TemporaryFolder folder;
  const auto files = write(three_missions(), folder.path());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0], folder / "fused.g2o");
  EXPECT_EQ(files[1], folder / "fused_island_1.g2o");
  EXPECT_EQ(read_g2o(files[1]).nodes.size(), 2u);
  EXPECT_EQ(read_g2o(files[1]).nodes[0].id, 20000);
}

TEST(G2oExporter, ReadsBackBitForBit) {
  const TemporaryFolder folder;
  const Atlas atlas = three_missions();
  write(atlas, folder.path());
  const Mission back = read_g2o(folder / "fused.g2o");
  ASSERT_EQ(back.nodes.size(), 7u);
  ASSERT_EQ(back.edges.size(), 3u + 2u + 1u);
  for (std::size_t i = 0; i < 3; ++i) {
    const SE3& T = back.nodes[4 + i].T_mission_node;
    EXPECT_EQ(T.t, atlas.T_map_node({1, std::uint32_t(i)}).t);
    EXPECT_EQ(T.q.coeffs(), atlas.T_map_node({1, std::uint32_t(i)}).q.coeffs());
  }
  EXPECT_EQ(back.edges[5].T_tail_head.t, atlas.loops[0].T_tail_head.t);
  EXPECT_EQ(back.edges[5].head, 10002);
  ASSERT_TRUE(back.georeference);
  EXPECT_EQ(back.georeference->T_map_enu.t, Vec3(1, 2, 3));
}

TEST(G2oExporter, SecondWriteHasTheSameBytes) {
  const TemporaryFolder one, two;
  write(three_missions(), one.path());
  write(three_missions(), two.path());
  EXPECT_EQ(read_file(one / "fused.g2o"), read_file(two / "fused.g2o"));
}

TEST(G2oExporter, NamesTheFolderThatIsNotThere) {
  try {
    write(three_missions(), "/no/such/folder");
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::data);
    EXPECT_NE(error.where().find("/no/such/folder"), std::string::npos);
  }
}

}  // namespace
}  // namespace cambium::testing
