// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <tuple>

#include "cambium/files.hpp"
#include "support/plain_context.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

/// What a header says and the floats that follow it.
struct Parsed {
  std::size_t points = 0, fields = 0;
  std::vector<float> values;
};

Parsed parse(const std::filesystem::path& file, const std::string& count_key,
             const std::string& end_of_header) {
  const std::string text = read_file(file);
  Parsed out;
  out.points = std::stoul(text.substr(text.find(count_key) + count_key.size()));
  const std::size_t begin = text.find(end_of_header) + end_of_header.size();
  out.values.resize((text.size() - begin) / sizeof(float));
  std::memcpy(out.values.data(), text.data() + begin, out.values.size() * sizeof(float));
  out.fields = out.points ? out.values.size() / out.points : 0;
  EXPECT_EQ(out.fields * out.points * sizeof(float), text.size() - begin);
  return out;
}
Parsed parse_ply(const std::filesystem::path& file) {
  return parse(file, "element vertex ", "end_header\n");
}
Parsed parse_pcd(const std::filesystem::path& file) {
  return parse(file, "\nPOINTS ", "DATA binary\n");
}

Cloud points(std::vector<float> xyz) {
  Cloud cloud;
  cloud.xyz = std::move(xyz);
  return cloud;
}

Atlas forest(int missions = 2) {
  std::vector<Mission> all;
  for (int m = 0; m < missions; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(SE3::from_yaw(0.3 * i, {3.0 * i, 2.0 * m, 1}));
    all.push_back(make_mission(std::string(1, char('a' + m)), poses));
    for (Node& node : all.back().nodes)
      node.payload = in_memory(forest_scan(node.T_mission_node, 1, 5000));
  }
  Atlas atlas = make_atlas(all);
  if (missions == 2) {
    atlas.islands = {{{0, 1}, {}}};
    atlas.missions[1].island = 0;
  }
  return atlas;
}

std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                         const std::string& yaml = "{}", int threads = 1) {
  return component<MapExporter>("cloud", yaml)->write(atlas, folder, *make_context(threads));
}

TEST(CloudExporter, MovesPointsIntoTheMapFrame) {
  const TemporaryFolder folder;
  Mission mission = make_mission("a", {SE3::from_yaw(M_PI / 2, {10, 20, 30})});
  mission.nodes[0].payload = in_memory(points({1, 0, 0}));
  const auto files = write(make_atlas({mission}), folder.path());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0], folder / "cloud.ply");
  const Parsed ply = parse_ply(files[0]);
  ASSERT_EQ(ply.values.size(), 3u);
  EXPECT_NEAR(ply.values[0], 10, 1e-6);
  EXPECT_NEAR(ply.values[1], 21, 1e-6);
  EXPECT_NEAR(ply.values[2], 30, 1e-6);
}

TEST(CloudExporter, KeepsOnePointPerVoxelAndEveryVoxel) {
  const TemporaryFolder folder;
  const Atlas atlas = forest();
  constexpr double voxel = 0.5;
  using Voxel = std::tuple<long, long, long>;
  const auto voxel_of = [&](const Vec3& p) {
    return Voxel(std::floor(p.x() / voxel), std::floor(p.y() / voxel), std::floor(p.z() / voxel));
  };
  std::set<Voxel> expected;
  for (std::uint32_t m = 0; m < 2; ++m)
    for (std::uint32_t n = 0; n < 3; ++n) {
      const auto cloud = atlas.payload({m, n}).cloud;
      for (std::size_t i = 0; i < cloud->size(); ++i)
        expected.insert(voxel_of(atlas.T_map_node({m, n}).rotation() *
                                     cloud->points().col(Eigen::Index(i)).cast<double>() +
                                 atlas.T_map_node({m, n}).t));
    }
  const Parsed ply = parse_ply(write(atlas, folder.path(), "{voxel_size: 0.5}")[0]);
  EXPECT_EQ(ply.points, expected.size());
}

TEST(CloudExporter, BothFormatsHoldTheSamePoints) {
  const TemporaryFolder folder;
  const Parsed ply = parse_ply(write(forest(), folder.path(), "{format: ply}")[0]);
  const Parsed pcd = parse_pcd(write(forest(), folder.path(), "{format: pcd}")[0]);
  EXPECT_GT(ply.points, 1000u);
  EXPECT_EQ(ply.points, pcd.points);
  EXPECT_EQ(ply.values, pcd.values);
}

TEST(CloudExporter, AnyNumberOfThreadsWritesTheSameBytes) {
  const TemporaryFolder one, four;
  EXPECT_EQ(read_file(write(forest(), one.path(), "{}", 1)[0]),
            read_file(write(forest(), four.path(), "{}", 4)[0]));
}

TEST(CloudExporter, TellsHowFarItIs) {
  const TemporaryFolder folder;
  const CountingContext context;
  component<MapExporter>("cloud")->write(forest(), folder.path(), context);
  EXPECT_GT(context.expected, 1u);
  EXPECT_EQ(context.done, context.expected);
}

TEST(CloudExporter, WritesOneFilePerIslandOrMission) {
  const TemporaryFolder folder;
  const auto per_mission = write(forest(), folder.path(), "{per_mission: true}");
  ASSERT_EQ(per_mission.size(), 2u);
  EXPECT_EQ(per_mission[1], folder / "cloud_b.ply");
  const auto per_island = write(forest(3), folder.path());
  ASSERT_EQ(per_island.size(), 3u);
  EXPECT_EQ(per_island[2], folder / "cloud_island_2.ply");
}

TEST(CloudExporter, KeepsIntensities) {
  const TemporaryFolder folder;
  Mission mission = make_mission("a", {SE3{}});
  Cloud cloud = points({1, 0, 0, 5, 0, 0});
  cloud.intensity = {7, 8};
  mission.nodes[0].payload = in_memory(cloud);
  const Parsed ply = parse_ply(write(make_atlas({mission}), folder.path())[0]);
  EXPECT_EQ(ply.values, (std::vector<float>{1, 0, 0, 7, 5, 0, 0, 8}));
}

TEST(CloudExporter, LeavesOutWhatIsNoPoint) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mission mission = make_mission("a", {SE3{}, SE3{}, SE3{}});
  mission.nodes[0].payload = in_memory(points({}));
  mission.nodes[1].payload = in_memory(points({nan, 0, 0, 1e30f, 0, 0, 1, 2, 3}));
  const auto files = write(make_atlas({mission}), folder.path());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(parse_ply(files[0]).values, (std::vector<float>{1, 2, 3}));
}

TEST(CloudExporter, WritesNothingWithoutClouds) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write(make_atlas({make_mission("a", {SE3{}})}), folder.path()).empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cambium::testing
