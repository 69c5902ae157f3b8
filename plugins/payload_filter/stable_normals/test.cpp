// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

/// A number between 0 and 1 that depends on i and k only.
double noise(std::size_t i, std::uint64_t k) {
  return double(Hasher().add(std::uint64_t(i)).add(k).digest().low >> 11) * 0x1.0p-53;
}

void add(Cloud& cloud, const Vec3& p) {
  for (int k = 0; k < 3; ++k) cloud.xyz.push_back(float(p[k]));
}

/// 4 x 4 m, 3 m in front and below, with 5 mm of noise.
Cloud ground(std::size_t points = 6000) {
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i)
    add(cloud, {1 + 4 * noise(i, 1), 4 * noise(i, 2) - 2, -1.5 + 0.01 * noise(i, 3)});
  return cloud;
}

/// A trunk at x = 4 m, seen from all sides.
Cloud trunk(double radius, std::size_t points = 3000) {
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i) {
    const double a = 2 * M_PI * noise(i, 4), r = radius + 0.01 * (noise(i, 5) - 0.5);
    add(cloud, {4 + r * std::cos(a), r * std::sin(a), 3 * noise(i, 6) - 1.5});
  }
  return cloud;
}

Cloud leaves(std::size_t points = 2000) {
  Cloud cloud;
  for (std::size_t i = 0; i < points; ++i)
    add(cloud, {3 + 1.5 * noise(i, 7), 1.5 * noise(i, 8), 1.5 * noise(i, 9)});
  return cloud;
}

Payload apply(const std::string& yaml, Payload payload, const SE3& T_mission_node = {}) {
  Mission mission = make_mission("a", {T_mission_node});
  mission.nodes[0].payload = in_memory(std::move(payload));
  const Atlas atlas = make_atlas({mission});
  return component<PayloadFilter>("stable_normals", yaml)->apply({atlas, 0}, 0, *make_context());
}

Cloud filtered(const Cloud& cloud, const std::string& yaml = "{}", const SE3& T = {}) {
  return *apply(yaml, Payload{std::make_shared<const Cloud>(cloud), nullptr}, T).cloud;
}

double kept(const Cloud& cloud) { return double(filtered(cloud).size()) / double(cloud.size()); }

TEST(StableNormals, KeepsGroundAndTrunksAndDropsLeaves) {
  EXPECT_GT(kept(ground()), 0.95);
  EXPECT_GT(kept(trunk(0.05)), 0.9);
  EXPECT_GT(kept(trunk(0.4, 12000)), 0.9);
  EXPECT_LT(kept(leaves()), 0.1);
}

TEST(StableNormals, NormalsOfGroundPointUpToTheSensor) {
  const Cloud out = filtered(ground());
  ASSERT_EQ(out.normals.size(), out.xyz.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_GT(out.normals[3 * i + 2], 0.97f);
}

TEST(StableNormals, NormalsOfAThinTrunkPointAwayFromItsAxis) {
  const Cloud out = filtered(trunk(0.05));
  std::size_t right = 0;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 p(out.xyz[3 * i] - 4, out.xyz[3 * i + 1], 0);
    const Vec3 n(out.normals[3 * i], out.normals[3 * i + 1], out.normals[3 * i + 2]);
    EXPECT_NEAR(n.norm(), 1, 1e-5);
    right += n.dot(p.normalized()) > 0.7;
  }
  EXPECT_GT(right, 0.98 * double(out.size()));  // the ends of a trunk are no lines
}

TEST(StableNormals, GravityIsTakenFromThePose) {
  // The robot lies on its side: what stands in the world lies in its frame.
  SE3 T;
  T.q = Quat(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitX()));
  const Cloud thin = trunk(0.05), lying = transformed(T.inverse(), thin);
  EXPECT_LT(double(filtered(lying).size()), 0.02 * double(thin.size()));
  EXPECT_NEAR(double(filtered(lying, "{}", T).size()), double(filtered(thin).size()),
              0.05 * double(thin.size()));
}

TEST(StableNormals, ARingOfASparseScanIsNoSurface) {
  Cloud ring;
  for (int i = 0; i < 1000; ++i)
    add(ring, {6 * std::cos(2 * M_PI * i / 1000), 6 * std::sin(2 * M_PI * i / 1000), -1.5});
  EXPECT_EQ(filtered(ring).size(), 0u);
}

TEST(StableNormals, TheSameForAnyOrderOfThePoints) {
  const Cloud cloud = ground(2000);
  std::vector<std::size_t> reversed(cloud.size());
  for (std::size_t i = 0; i < reversed.size(); ++i) reversed[i] = reversed.size() - 1 - i;
  Cloud out = filtered(select(cloud, reversed));
  std::vector<std::size_t> back(out.size());
  for (std::size_t i = 0; i < back.size(); ++i) back[i] = back.size() - 1 - i;
  EXPECT_EQ(select(out, back).xyz, filtered(cloud).xyz);
}

TEST(StableNormals, IntensityStaysWithItsPointAndNormalsAreOptional) {
  Cloud cloud = ground();
  for (std::size_t i = 0; i < cloud.size(); ++i) cloud.intensity.push_back(cloud.xyz[3 * i]);
  const Cloud out = filtered(cloud, "{normals: false}");
  EXPECT_TRUE(out.normals.empty());
  ASSERT_EQ(out.intensity.size(), out.size());
  for (std::size_t i = 0; i < out.size(); ++i) EXPECT_EQ(out.intensity[i], out.xyz[3 * i]);
}

TEST(StableNormals, BadPointsEmptyCloudsAndTrees) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Cloud cloud = ground();
  cloud.xyz.insert(cloud.xyz.end(), {nan, 0, 0, 0, 0, 1e30f});
  EXPECT_EQ(filtered(cloud).xyz, filtered(ground()).xyz);
  EXPECT_TRUE(filtered(Cloud{}).empty());
  const auto trees = std::make_shared<const std::vector<Tree>>(2);
  EXPECT_EQ(apply("{}", Payload{nullptr, trees}).trees, trees);
}

TEST(StableNormals, RefusesBadParameters) {
  for (const char* yaml : {"{radius: 0}", "{scale: 1}", "{min_points: 2}", "{max_variation: 0.5}",
                           "{max_angle: 2}", "{k: 3}"})
    EXPECT_THROW(component<PayloadFilter>("stable_normals", yaml), Error) << yaml;
  EXPECT_TRUE(component<PayloadFilter>("stable_normals")->uses_neighbours());
}

}  // namespace
}  // namespace cambium::testing
