// SPDX-License-Identifier: BSD-3-Clause
// The made-up data that other tests rest on must be what it says.
#include "support/support.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

namespace cambium::testing {
namespace {

TEST(Support, parallel_for_throws_the_exception_of_the_lowest_index) {
  for (const int threads : {1, 4}) {
    const auto context = make_context(threads);
    try {
      context->parallel_for(100, [](std::size_t i) {
        if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& e) {
      EXPECT_STREQ(e.what(), "3");
    }
  }
}

TEST(Support, forest_scans_repeat_and_stay_in_range) {
  const SE3 T_world_base = SE3::from_yaw(0.5, {10, 20, 1});
  const Cloud cloud = forest_scan(T_world_base, 7, 5000);
  EXPECT_EQ(cloud.size(), 5000u);
  EXPECT_EQ(cloud.xyz, forest_scan(T_world_base, 7, 5000).xyz);
  EXPECT_NE(cloud.xyz, forest_scan(T_world_base, 8, 5000).xyz);
  EXPECT_LT(cloud.points().topRows<2>().colwise().norm().maxCoeff(), 30.5F);
}

double mean_distance(const Cloud& from, const Cloud& to) {
  double sum = 0;
  for (Eigen::Index i = 0; i < from.points().cols(); ++i)
    sum += (to.points().colwise() - from.points().col(i)).colwise().norm().minCoeff();
  return sum / double(from.size());
}

TEST(Support, scans_of_one_forest_overlap_and_of_two_do_not) {
  const SE3 T_world_a, T_world_b = SE3::from_yaw(1.0, {2, 1, 0});
  const Cloud a = forest_scan(T_world_a, 1, 4000);
  const Cloud b = transformed(T_world_b, forest_scan(T_world_b, 1, 4000));
  const Cloud other = transformed(T_world_b, forest_scan(T_world_b, 2, 4000));
  EXPECT_LT(mean_distance(a, b), 0.6 * mean_distance(a, other));
}

TEST(Support, atlas_orders_missions_and_keeps_their_payloads) {
  Mission b = make_mission("b", {SE3{}, SE3::from_yaw(0.1, {1, 0, 0})});
  b.nodes[1].payload = in_memory(forest_scan(SE3{}, 1, 10));
  const Atlas atlas = make_atlas({b, make_mission("a", {SE3{}})});
  EXPECT_EQ(atlas.mission({0, 0}).name, "a");
  EXPECT_EQ(atlas.islands.size(), 2u);
  EXPECT_EQ(atlas.payload({1, 1}).cloud->size(), 10u);
  EXPECT_EQ(atlas.payload({1, 0}).cloud, nullptr);
  const Edge& edge = atlas.mission({1, 0}).edges.at(0);
  EXPECT_LT(residual(edge.T_tail_head, atlas.T_map_node({1, 0}), atlas.T_map_node({1, 1})).norm(),
            1e-12);
}

TEST(Support, digests_in_memory_follow_the_content) {
  const auto scan = [](std::uint64_t seed) { return in_memory(forest_scan(SE3{}, seed, 50)); };
  EXPECT_EQ(scan(1)->digest(), scan(1)->digest());
  EXPECT_NE(scan(1)->digest(), scan(2)->digest());
}

TEST(Support, temporary_folders_go_with_their_scope) {
  std::filesystem::path path;
  {
    const TemporaryFolder folder;
    path = folder.path();
    std::ofstream(folder / "file") << "x";
    EXPECT_TRUE(std::filesystem::exists(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Support, real_data_unpacks_once_under_concurrency) {
  std::vector<std::filesystem::path> found(4);
  std::vector<std::thread> threads;
  for (auto& path : found) threads.emplace_back([&] { path = real_data("pose_graphs"); });
  for (auto& thread : threads) thread.join();
  if (found[0].empty()) GTEST_SKIP() << "no archive pose_graphs.tar.xz in ../shared/data";
  EXPECT_EQ(std::set<std::filesystem::path>(found.begin(), found.end()).size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(found[0] / "ORIGIN.txt") ||
              std::filesystem::exists(found[0] / "REFERENCE.json"));
  EXPECT_TRUE(real_data("no_such_archive").empty());
}

}  // namespace
}  // namespace cambium::testing
