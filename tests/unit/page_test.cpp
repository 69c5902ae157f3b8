// SPDX-License-Identifier: BSD-3-Clause
#include "report/page.hpp"

#include <cmath>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

/// b lies 10 m beside a; its odometry turns away from where the map puts its second node.
Atlas two_missions() {
  Atlas atlas = make_atlas({make_mission("a", {SE3{}, SE3::from_yaw(0, {2, 0, 0})}),
                            make_mission("b", {SE3{}, SE3::from_yaw(0, {2, 1, 0})})});
  atlas.missions[1].island = 0;
  atlas.islands = {{{0, 1}, {}}};
  atlas.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(
      std::vector<SE3>{SE3::from_yaw(0, {0, 10, 0}), SE3::from_yaw(0, {2, 10, 0})});
  Loop loop;
  loop.tail = {0, 1};
  loop.head = {1, 1};
  loop.state = LoopState::accepted;
  loop.proposed_by = "scan_context";
  loop.registered_by = "gicp";
  loop.decided_by = "pairwise_consistency";
  loop.T_tail_head = SE3::from_yaw(0, {0, 10.25, 0});
  loop.scores = {{"overlap", 0.123456}};
  atlas.loops = {loop};
  return atlas;
}

Json report(const std::string& warning = "none") {
  return {{"cambium", "1"},
          {"islands", Json::array()},
          {"steps", Json::array()},
          {"metrics", Json::array()},
          {"warnings", Json::array({warning})}};
}

std::string script(const std::string& page, const std::string& id) {
  const auto begin = page.find("id=\"" + id + "\">") + id.size() + 6;
  return page.substr(begin, page.find("</script>", begin) - begin);
}

TEST(Page, LoopsAreHeldAgainstTheOdometryAndTheMap) {
  const Json ledger = page_ledger(two_missions());
  EXPECT_EQ(ledger["before_m"][0], 0.75);  // b is placed by its first node, and 1 m to the side
  EXPECT_EQ(ledger["after_m"][0], 0.25);
  EXPECT_EQ(ledger["after_deg"][0], 0.0);
  EXPECT_EQ(ledger["scores"][0][1], 0.1235);
  EXPECT_EQ(ledger["strings"][ledger["scores"][0][0].get<int>()], "overlap");
}

TEST(Page, WhatWasNotRegisteredHasNoDifference) {
  Atlas atlas = two_missions();
  atlas.loops[0].state = LoopState::rejected;
  atlas.loops[0].decided_by = "gicp";
  const Json ledger = page_ledger(atlas);
  EXPECT_TRUE(ledger["before_m"][0].is_null());
  EXPECT_TRUE(ledger["weight"][0].is_null());
  atlas = two_missions();  // and none between frames that say nothing of each other
  atlas.missions[1].island = 1;
  EXPECT_TRUE(page_ledger(atlas)["after_m"][0].is_null());
}

TEST(Page, FixesLieInTheMapAndAreThinned) {
  Atlas atlas = two_missions();
  Mission mission = *atlas.missions[0].mission;
  for (int i = 0; i < 7000; ++i)
    mission.fixes.push_back({{i, 0}, 61, 25, 100 + 0.001 * i, Mat3::Identity()});
  atlas.missions[0].mission = std::make_shared<const Mission>(mission);
  EXPECT_TRUE(page_missions(atlas)[0]["fixes"].empty());  // nothing ties the map to the globe
  atlas.islands[0].georeference = GeoReference{61, 25, 100, SE3::from_yaw(0, {5, 6, 7}), 0, 0};
  const Json missions = page_missions(atlas);
  EXPECT_EQ(missions[0]["fix_step"], 3);
  EXPECT_EQ(missions[0]["fixes"].size(), 3 * 2334u);
  EXPECT_EQ(missions[0]["fixes"][0], 5.0);
  EXPECT_NEAR(missions[0]["fixes"][5].get<double>(), 7.003, 1e-9);
  EXPECT_EQ(missions[1]["odometry"], Json({0.0, 10.0, 0.0, 2.0, 11.0, 0.0}));
}

TEST(Page, NoTextEndsTheScriptThatHoldsIt) {
  const std::string evil = "</script><script>alert(1)</script> /*RUN*/ /*MAP*/ \xff";
  const std::string page = report_page(two_missions(), report(evil), "yaml: " + evil);
  const Json run = Json::parse(script(page, "run"));
  EXPECT_EQ(run["warnings"][0].get<std::string>().substr(0, 9), "</script>");
  EXPECT_EQ(Json::parse(script(page, "map"))["missions"].size(), 2u);
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
}

TEST(Page, RoundsToSignificantDigits) {
  EXPECT_EQ(significant(0.00123456, 3), 0.00123);
  EXPECT_EQ(significant(-98765.4, 3), -98800);
  EXPECT_EQ(significant(0, 3), 0);
  EXPECT_TRUE(std::isnan(significant(NAN, 3)));
}

}  // namespace
}  // namespace cambium::testing
