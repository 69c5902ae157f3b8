// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

Payload filtered(const std::string& yaml, Payload payload) {
  Mission mission = make_mission("a", {SE3{}});
  mission.nodes[0].payload = in_memory(std::move(payload));
  const Atlas atlas = make_atlas({mission});
  return component<PayloadFilter>("range_crop", yaml)->apply({atlas, 0}, 0, *make_context());
}

std::vector<float> filtered(const std::string& yaml, const std::vector<float>& xyz) {
  auto cloud = std::make_shared<Cloud>();
  cloud->xyz = xyz;
  return filtered(yaml, Payload{cloud, nullptr}).cloud->xyz;
}

TEST(RangeCrop, KeepsWhatIsBetweenTheRanges) {
  EXPECT_EQ(filtered("{min_range: 1, max_range: 5}", {0.5f, 0, 0, 0, 3, 4, 0, 2, 0, 3, 4, 1}),
            (std::vector<float>{0, 3, 4, 0, 2, 0}));  // the limits belong to the range
}

TEST(RangeCrop, KeepsWhatIsBetweenTheHeights) {
  EXPECT_EQ(filtered("{z_limits: [-1, 2]}", {3, 0, -1.5f, 3, 0, -1, 3, 0, 2, 3, 0, 2.5f}),
            (std::vector<float>{3, 0, -1, 3, 0, 2}));
}

TEST(RangeCrop, KeepsNormalsAndIntensityOfTheirPoints) {
  auto cloud = std::make_shared<Cloud>();
  cloud->xyz = {100, 0, 0, 3, 0, 0};
  cloud->normals = {1, 0, 0, 0, 0, 1};
  cloud->intensity = {5, 6};
  const auto out = filtered("{}", Payload{cloud, nullptr}).cloud;
  EXPECT_EQ(out->normals, (std::vector<float>{0, 0, 1}));
  EXPECT_EQ(out->intensity, (std::vector<float>{6}));
}

TEST(RangeCrop, DropsWhatIsNotFinite) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(filtered("{}", {nan, 1, 1, 1, inf, 1, 1, 1, 1}), (std::vector<float>{1, 1, 1}));
}

TEST(RangeCrop, EmptyCloudNoCloudAndTreesPass) {
  EXPECT_TRUE(filtered("{}", std::vector<float>{}).empty());
  const auto trees = std::make_shared<const std::vector<Tree>>(3);
  const Payload out = filtered("{}", Payload{nullptr, trees});
  EXPECT_EQ(out.cloud, nullptr);
  EXPECT_EQ(out.trees, trees);
}

TEST(RangeCrop, RefusesBadParameters) {
  for (const char* yaml : {"{min_range: -1}", "{max_range: 0}", "{min_range: 5, max_range: 5}",
                           "{z_limits: [1]}", "{z_limits: [2, 1]}", "{range: 1}"})
    EXPECT_THROW(component<PayloadFilter>("range_crop", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
