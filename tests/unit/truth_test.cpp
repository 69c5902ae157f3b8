// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/truth.hpp"

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

Atlas atlas_with_folder(const std::filesystem::path& folder) {
  Mission mission =
      make_mission("a", {SE3{}, SE3::from_yaw(0, {1, 0, 0}), SE3::from_yaw(0, {2, 0, 0})});
  mission.folder = folder;
  for (int i = 0; i < 3; ++i)
    mission.nodes[std::size_t(i)].stamp = Stamp{1'600'000'000 + i, 999'999'995};
  return make_atlas({mission});
}

// One row is 5 ns after node 0 (across the second), one is 20 ms before node 1, none near node 2.
const char* const rows =
    "# stamp x y z qx qy qz qw\n"
    "1600000001.979999995 11 0 0 0 0 0 1\n"
    "1600000001.000000000 10 0 0 0 0 0 1\n";

TEST(Truth, TakesTheNearestPoseInTime) {
  const TemporaryFolder folder;
  write_file(folder / "ground_truth.tum", rows);
  const Atlas atlas = atlas_with_folder(folder.path());
  const Truth narrow = read_truth(atlas, {}, 0.01);
  EXPECT_EQ(narrow.matched, 1u);
  ASSERT_TRUE(narrow.at({0, 0}));
  EXPECT_EQ(narrow.at({0, 0})->t.x(), 10);
  EXPECT_FALSE(narrow.at({0, 1}));
  const Truth wide = read_truth(atlas, {}, 0.05);
  EXPECT_EQ(wide.matched, 2u);
  EXPECT_EQ(wide.at({0, 1})->t.x(), 11);
}

TEST(Truth, LooksIntoTheReferenceFolder) {
  const TemporaryFolder folder;
  const Atlas atlas = atlas_with_folder("/nowhere");
  EXPECT_EQ(read_truth(atlas, folder.path(), 0.01).matched, 0u);
  EXPECT_THROW(read_truth(atlas, folder.path(), 0.01).require_matches(), Error);
  write_file(folder / "a.tum", rows);
  EXPECT_EQ(read_truth(atlas, folder.path(), 0.01).matched, 1u);
}

TEST(Truth, NodesThatShareTheirStampHaveNoTruth) {
  const TemporaryFolder folder;
  write_file(folder / "a.tum", rows);
  Atlas atlas = atlas_with_folder("/nowhere");
  Mission stuck = *atlas.missions[0].mission;
  stuck.nodes[1].stamp = stuck.nodes[0].stamp;
  atlas.missions[0].mission = std::make_shared<const Mission>(stuck);
  EXPECT_EQ(read_truth(atlas, folder.path(), 0.01).matched, 0u);
}

TEST(Truth, NodesWithoutAStampHaveNoTruth) {
  const TemporaryFolder folder;
  write_file(folder / "a.tum", rows);
  Atlas atlas = atlas_with_folder("/nowhere");
  Mission bare = *atlas.missions[0].mission;
  for (Node& node : bare.nodes) node.stamp.reset();
  atlas.missions[0].mission = std::make_shared<const Mission>(bare);
  EXPECT_EQ(read_truth(atlas, folder.path(), 1e9).matched, 0u);
}

}  // namespace
}  // namespace cambium::testing
