// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

Payload filtered(const std::string& yaml, Payload payload) {
  Mission mission = make_mission("a", {SE3{}});
  mission.nodes[0].payload = in_memory(std::move(payload));
  const Atlas atlas = make_atlas({mission});
  return component<PayloadFilter>("voxel_grid", yaml)->apply({atlas, 0}, 0, *make_context());
}

Cloud filtered(const std::string& yaml, Cloud cloud) {
  return *filtered(yaml, Payload{std::make_shared<const Cloud>(std::move(cloud)), nullptr}).cloud;
}

TEST(VoxelGrid, MeansOfPositionNormalAndIntensity) {
  Cloud cloud;
  cloud.xyz = {0.1f, 0.1f, 0.1f, 0.3f, 0.5f, 0.7f, -0.2f, 0.4f, 0.4f};
  cloud.normals = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  cloud.intensity = {10, 30, 7};
  const Cloud out = filtered("{size: 1.0}", cloud);
  ASSERT_EQ(out.size(), 2u);  // x < 0 is another voxel: the grid goes through the origin
  EXPECT_EQ(out.points().col(0), Eigen::Vector3f(-0.2f, 0.4f, 0.4f));
  EXPECT_TRUE(out.points().col(1).isApprox(Eigen::Vector3f(0.2f, 0.3f, 0.4f)));
  EXPECT_NEAR(out.normals[3], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(out.normals[4], std::sqrt(0.5), 1e-6);
  EXPECT_EQ(out.normals[5], 0);
  EXPECT_EQ(out.intensity, (std::vector<float>{7, 20}));
}

TEST(VoxelGrid, AVoxelHasALabelWhenItsPointsAgree) {
  Cloud cloud;
  cloud.xyz = {0.1f, 0, 0, 0.2f, 0, 0, 1.1f, 0, 0, 1.2f, 0, 0, 1.3f, 0, 0};
  cloud.label = {64, 64, 2, 66, 2};
  EXPECT_EQ(filtered("{size: 1.0}", cloud).label, (std::vector<std::uint8_t>{64, 0}));
}

TEST(VoxelGrid, OppositeNormalsStillGiveAUnitNormal) {
  Cloud cloud;
  cloud.xyz = {0.1f, 0.1f, 0.1f, 0.2f, 0.2f, 0.2f};
  cloud.normals = {0, 0, 1, 0, 0, -1};
  const Cloud out = filtered("{size: 1.0}", cloud);
  ASSERT_EQ(out.normals.size(), 3u);
  EXPECT_EQ(std::abs(out.normals[2]), 1.0f);
}

TEST(VoxelGrid, DoesNotDependOnTheOrderOfThePoints) {
  const Cloud cloud = forest_scan(SE3{});
  std::vector<std::size_t> reversed(cloud.size());
  for (std::size_t i = 0; i < reversed.size(); ++i) reversed[i] = reversed.size() - 1 - i;
  EXPECT_EQ(filtered("{size: 0.5}", cloud).xyz,
            filtered("{size: 0.5}", select(cloud, reversed)).xyz);
}

TEST(VoxelGrid, OnePointPerVoxelAndInsideIt) {
  const Cloud cloud = forest_scan(SE3{});
  const Cloud out = filtered("{size: 0.5}", cloud);
  const auto voxels = [](const Cloud& c) {
    std::vector<std::array<int, 3>> cells;
    for (std::size_t i = 0; i < c.size(); ++i) {
      const auto cell = [&](std::size_t k) { return int(std::floor(c.xyz[3 * i + k] / 0.5f)); };
      cells.push_back({cell(0), cell(1), cell(2)});
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  };
  auto expected = voxels(cloud);
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(voxels(out), expected);
  EXPECT_LT(out.size(), cloud.size());
}

TEST(VoxelGrid, MinPointsDropsSparseVoxels) {
  Cloud cloud;
  cloud.xyz = {0.1f, 0.1f, 0.1f, 0.2f, 0.2f, 0.2f, 5, 5, 5};
  EXPECT_EQ(filtered("{size: 1.0, min_points: 2}", cloud).size(), 1u);
  EXPECT_EQ(filtered("{size: 1.0, min_points: 3}", cloud).size(), 0u);
}

TEST(VoxelGrid, DropsWhatIsNotFiniteOrTooFar) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  Cloud cloud;
  cloud.xyz = {nan, 0, 0, 0, inf, 0, 0, 0, -1e30f, 1, 2, 3};
  EXPECT_EQ(filtered("{size: 0.1}", cloud).xyz, (std::vector<float>{1, 2, 3}));
}

TEST(VoxelGrid, EmptyCloudNoCloudAndTreesPass) {
  EXPECT_TRUE(filtered("{}", Cloud{}).empty());
  const auto trees = std::make_shared<const std::vector<Tree>>(3);
  const Payload out = filtered("{}", Payload{nullptr, trees});
  EXPECT_EQ(out.cloud, nullptr);
  EXPECT_EQ(out.trees, trees);
}

TEST(VoxelGrid, RefusesBadParameters) {
  for (const char* yaml : {"{size: 0}", "{size: -1}", "{min_points: 0}", "{leaf: 1}"})
    EXPECT_THROW(component<PayloadFilter>("voxel_grid", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
