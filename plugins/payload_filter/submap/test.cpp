// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// Nodes 5 m apart on a line, each with the same cloud in its own frame.
Mission line(std::size_t nodes, const Cloud& cloud) {
  std::vector<SE3> poses;
  for (std::size_t i = 0; i < nodes; ++i)
    poses.push_back(SE3::from_yaw(0.3 * double(i), {5.0 * double(i), 0, 0}));
  Mission mission = make_mission("a", poses);
  for (Node& node : mission.nodes) node.payload = in_memory(cloud);
  return mission;
}

Cloud filtered(const Atlas& atlas, std::size_t node, const std::string& yaml) {
  return *component<PayloadFilter>("submap", yaml)->apply({atlas, 0}, node, *make_context()).cloud;
}

Cloud origin() {
  Cloud cloud;
  cloud.xyz = {0, 0, 0};
  return cloud;
}

/// The x of every point, rounded, in the order of the cloud.
std::vector<int> xs(const Cloud& cloud) {
  std::vector<int> out;
  for (std::size_t i = 0; i < cloud.size(); ++i) out.push_back(int(std::lround(cloud.xyz[3 * i])));
  return out;
}

TEST(Submap, JoinsTheNodesWithinTheRadiusAlongThePath) {
  Mission mission = line(9, origin());
  for (Node& node : mission.nodes) node.T_mission_node.q = Quat::Identity();
  const Atlas atlas = make_atlas({mission});
  EXPECT_EQ(xs(filtered(atlas, 4, "{radius: 11, voxel: 0}")),
            (std::vector<int>{-10, -5, 0, 5, 10}));
  EXPECT_EQ(xs(filtered(atlas, 0, "{radius: 11, voxel: 0}")), (std::vector<int>{0, 5, 10}));
  EXPECT_EQ(xs(filtered(atlas, 8, "{radius: 0, voxel: 0}")), (std::vector<int>{0}));
  EXPECT_EQ(xs(filtered(atlas, 4, "{radius: 20, voxel: 0, spacing: 8}")),
            (std::vector<int>{-20, -10, 0, 10, 20}));
  EXPECT_EQ(xs(filtered(atlas, 4, "{radius: 40, voxel: 0, max_range: 7}")),
            (std::vector<int>{-5, 0, 5}));
}

TEST(Submap, ARobotThatReturnsToAPlaceJoinsThePathNotThePlace) {
  Mission mission = make_mission("a", {SE3{}, {Quat::Identity(), {30, 0, 0}}, SE3{}});
  for (Node& node : mission.nodes) node.payload = in_memory(origin());
  EXPECT_EQ(filtered(make_atlas({mission}), 0, "{voxel: 0}").size(), 1u);
}

TEST(Submap, PointsNormalsAndIntensitiesComeIntoTheFrameOfTheNode) {
  Cloud cloud;  // one point of the world, as both nodes see it
  cloud.xyz = {2, 0, 1};
  cloud.normals = {0, 1, 0};
  cloud.intensity = {7};
  cloud.label = {64};
  const SE3 T_a_b = SE3::from_yaw(M_PI / 2, {1, 0, 0});
  Mission mission = make_mission("a", {SE3{}, T_a_b});
  mission.nodes[0].payload = in_memory(cloud);
  mission.nodes[1].payload = in_memory(transformed(T_a_b.inverse(), cloud));
  const Atlas atlas = make_atlas({mission});
  for (const char* yaml : {"{voxel: 0}", "{voxel: 0.5}"})
    for (const std::size_t node : {0, 1}) {
      const Cloud expected = transformed(node ? T_a_b.inverse() : SE3{}, cloud);
      const Cloud out = filtered(atlas, node, yaml);
      for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
          EXPECT_NEAR(out.xyz[3 * i + k], expected.xyz[k], 1e-5) << yaml;
          EXPECT_NEAR(out.normals[3 * i + k], expected.normals[k], 1e-5) << yaml;
        }
      EXPECT_EQ(out.intensity, std::vector<float>(out.size(), 7.f)) << yaml;
      EXPECT_EQ(out.label, std::vector<std::uint8_t>(out.size(), 64)) << yaml;
    }
}

TEST(Submap, PosesAreThoseOfTheRobotNotOfTheMap) {
  const Mission mission = line(3, forest_scan(SE3{}, 1, 500));
  Atlas atlas = make_atlas({mission});
  const Cloud before = filtered(atlas, 1, "{}");
  auto poses = *atlas.missions[0].T_map_node;
  poses[2].t.x() += 3;  // an optimisation moved the map
  atlas.missions[0].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  EXPECT_EQ(filtered(atlas, 1, "{}").xyz, before.xyz);
}

TEST(Submap, ThinnedIsTheVoxelGridOfAllPoints) {
  const Mission mission = line(4, forest_scan(SE3{}, 3, 2000));
  const Atlas atlas = make_atlas({mission});
  Mission joined = make_mission("b", {SE3{}});
  joined.nodes[0].payload = in_memory(filtered(atlas, 1, "{voxel: 0}"));
  const Atlas whole = make_atlas({joined});
  const auto grid = component<PayloadFilter>("voxel_grid", "{size: 0.3}");
  const Cloud expected = *grid->apply({whole, 0}, 0, *make_context()).cloud;
  const Cloud out = filtered(atlas, 1, "{voxel: 0.3}");
  ASSERT_EQ(out.size(), expected.size());
  for (std::size_t i = 0; i < out.xyz.size(); ++i) EXPECT_NEAR(out.xyz[i], expected.xyz[i], 1e-5);
}

TEST(Submap, ChannelsThatSomeCloudsLackAreLeftOut) {
  Cloud rich = origin();
  rich.intensity = {3};
  rich.label = {2};
  rich.normals = {0, 0, 1};
  Mission mission = line(2, origin());
  mission.nodes[1].payload = in_memory(rich);
  for (const char* yaml : {"{voxel: 0}", "{voxel: 0.1}"})
    for (const std::size_t node : {0, 1}) {
      const Cloud out = filtered(make_atlas({mission}), node, yaml);
      EXPECT_EQ(out.size(), 2u);
      EXPECT_TRUE(out.intensity.empty() && out.normals.empty() && out.label.empty()) << yaml;
    }
}

TEST(Submap, NodesWithoutCloudsAndPointsThatAreNotFinite) {
  Cloud bad = origin();
  bad.xyz.insert(bad.xyz.end(), {nan, 0, 0, 1, std::numeric_limits<float>::infinity(), 0});
  Mission mission = line(3, bad);
  mission.nodes[0].payload = nullptr;
  mission.nodes[2].payload = in_memory(Cloud{});
  EXPECT_EQ(filtered(make_atlas({mission}), 1, "{}").xyz, (std::vector<float>{0, 0, 0}));
  const auto trees = std::make_shared<const std::vector<Tree>>(3);
  mission.nodes[1].payload = in_memory(Payload{nullptr, trees});
  const Atlas atlas = make_atlas({mission});
  const Payload out = component<PayloadFilter>("submap")->apply({atlas, 0}, 1, *make_context());
  EXPECT_EQ(out.cloud, nullptr);
  EXPECT_EQ(out.trees, trees);
}

TEST(Submap, RefusesBadParameters) {
  for (const char* yaml : {"{radius: -1}", "{voxel: -1}", "{max_range: 0}", "{spacing: -1}",
                           "{voxel: 1e-6}", "{size: 1}"})
    EXPECT_THROW(component<PayloadFilter>("submap", yaml), Error) << yaml;
  EXPECT_TRUE(component<PayloadFilter>("submap")->uses_neighbours());
}

}  // namespace
}  // namespace cambium::testing
