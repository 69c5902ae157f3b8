// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "support/support.hpp"

using namespace cambium;
using cambium::testing::TemporaryFolder;

namespace {

std::string plan_of(const Atlas& atlas, const std::string& yaml = "{}") {
  const TemporaryFolder folder;
  const auto exporter = cambium::testing::component<MapExporter>("plan", yaml);
  const auto files = exporter->write(atlas, folder.path(), *cambium::testing::make_context());
  return read_file(files.at(0));
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

Atlas two_missions() {
  std::vector<SE3> path;
  for (int i = 0; i < 5; ++i) path.push_back(SE3::from_yaw(0, {10.0 * i, 0, 0}));
  Atlas atlas = cambium::testing::make_atlas(
      {cambium::testing::make_mission("a<b", path), cambium::testing::make_mission("c", path)});
  atlas.islands = {{{0, 1}, {}}};
  atlas.missions[1].island = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    Loop loop;
    loop.tail = {0, i};
    loop.head = {1, i};
    loop.state = i == 0 ? LoopState::rejected : LoopState::accepted;
    atlas.loops.push_back(loop);
  }
  return atlas;
}

}  // namespace

TEST(Plan, ShowsEveryMissionNodeAndAcceptedLoop) {
  const std::string svg = plan_of(two_missions());
  EXPECT_EQ(count(svg, "<circle"), 10u);
  EXPECT_EQ(count(svg, "stroke=\"#009e73\""), 2u);
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2u);
  EXPECT_NE(svg.find("2 accepted loops"), std::string::npos);
  EXPECT_NE(svg.find("a&lt;b, 5 nodes"), std::string::npos);  // names are escaped
}

TEST(Plan, ParametersAddAndTakeAway) {
  EXPECT_EQ(count(plan_of(two_missions(), "{odometry: false}"), "stroke-dasharray"), 0u);
  EXPECT_EQ(count(plan_of(two_missions(), "{rejected: true}"), "stroke=\"#d55e00\""), 1u);
  EXPECT_NE(plan_of(two_missions(), "{width: 500}").find("width=\"500\""), std::string::npos);
}

TEST(Plan, ASingleNodeGivesAPicture) {
  const std::string svg =
      plan_of(cambium::testing::make_atlas({cambium::testing::make_mission("alone", {SE3{}})}));
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}
