// SPDX-License-Identifier: BSD-3-Clause
// What changed between two surveys of made-up woods.
#include <algorithm>
#include <cmath>

#include "monitor/changes.hpp"
#include "monitor/changes_output.hpp"
#include "support/support.hpp"

namespace cambium::monitor {
namespace {

using testing::in_memory;
using testing::make_context;

/// Trees in rows with a gap of 2.5 m, each a little out of its row and with a diameter of its own.
std::vector<Tree> wood() {
  std::vector<Tree> trees;
  for (int i = 0; i < 100; ++i) {
    Tree t;
    t.base = {2.5 * (i % 10) + 0.4 * std::sin(5.0 * i), 2.5 * (i / 10) + 0.4 * std::cos(3.0 * i),
              0};
    t.dbh = 0.2 + 0.15 * std::abs(std::sin(7.0 * i));
    t.reconstructed = true;
    t.score = 1;
    trees.push_back(t);
  }
  return trees;
}

/// A flat floor and a wall of leaves, as rays from the node see them: points every 0.4 m around.
Cloud floor_and(const SE3& T_map_node, double floor, const std::vector<Vec3>& more) {
  Cloud cloud;
  const auto add = [&](const Vec3& p_map) {
    const Vec3 p = T_map_node.inverse() * p_map;
    for (int k = 0; k < 3; ++k) cloud.xyz.push_back(float(p[k]));
  };
  for (double x = -8; x < 8; x += 0.2)
    for (double y = -8; y < 8; y += 0.2) add({T_map_node.t.x() + x, T_map_node.t.y() + y, floor});
  for (const Vec3& p : more) add(p);
  return cloud;
}

/// A walk through the wood that sees every tree within 9 m. `T` moves it into its own map.
Survey walk(const std::string& name, const std::vector<Tree>& trees, double y_low, double y_high,
            double floor = 0, const SE3& T = {}, const std::vector<Vec3>& more = {}) {
  std::vector<SE3> poses;
  for (double y = y_low; y <= y_high; y += 4)
    for (double x = 1; x < 24; x += 2) poses.push_back(SE3::from_yaw(0.2 * x, {x, y, 1.5}));
  Mission mission = testing::make_mission(name, poses);
  for (Node& node : mission.nodes) {
    std::vector<Tree> seen;
    for (const Tree& t : trees)
      if ((t.base - node.T_mission_node.t).head<2>().norm() < 9) {
        seen.push_back(t);
        seen.back().base = node.T_mission_node.inverse() * t.base;
        seen.back().dbh += 0.01 * std::sin(double(node.id) + 10 * t.base.x());
      }
    node.payload = in_memory(
        Payload{std::make_shared<const Cloud>(floor_and(node.T_mission_node, floor, more)),
                std::make_shared<const std::vector<Tree>>(seen)});
  }
  Survey out;
  out.name = name;
  out.run = "/one/run";
  out.clouds = testing::make_atlas({mission});
  std::vector<SE3> moved;
  for (const SE3& pose : poses) moved.push_back(T * pose);
  out.clouds.missions[0].T_map_node = std::make_shared<const std::vector<SE3>>(moved);
  out.trees = out.clouds;
  out.has_trees = true;
  out.missions = {0};
  return out;
}

std::size_t count(const Changes& c, Change what) {
  return std::size_t(
      std::ranges::count_if(c.stems, [&](const StemChange& s) { return s.change == what; }));
}

ChangesOptions usual() { return {}; }

TEST(Changes, NothingChangedIsNoChange) {
  const auto c =
      changes(walk("a", wood(), 2, 22), walk("b", wood(), 4, 24), usual(), *make_context());
  EXPECT_EQ(count(c, Change::kept), 100u);
  EXPECT_EQ(c.stems.size(), 100u);
  for (const StemChange& s : c.stems) EXPECT_NEAR(s.growth, 0, 0.006);
  ASSERT_GT(c.cells.size(), 300u);
  for (const CellChange& cell : c.cells)
    if (cell.ground) EXPECT_NEAR(*cell.ground, 0, 1e-5);
}

TEST(Changes, FindsWhatWasFelledPlantedAndGrown) {
  std::vector<Tree> before = wood(), after = wood();
  for (Tree& t : after) t.dbh += 0.02;
  after[64].dbh = 0.04;               // a young one
  before.erase(before.begin() + 81);  // a thick one that the first survey did not see
  before.erase(before.begin() + 64);
  after.erase(after.begin() + 37);
  const auto c =
      changes(walk("a", before, 2, 22), walk("b", after, 2, 22), usual(), *make_context());
  ASSERT_EQ(count(c, Change::gone), 1u);
  ASSERT_EQ(count(c, Change::appeared), 1u);
  ASSERT_EQ(count(c, Change::overlooked), 1u);
  EXPECT_EQ(count(c, Change::kept), 97u);
  for (const StemChange& s : c.stems) {
    if (s.change == Change::gone) EXPECT_LT((s.base - wood()[37].base).norm(), 0.01);
    if (s.change == Change::appeared) EXPECT_LT((s.base - wood()[64].base).norm(), 0.01);
    if (s.change == Change::overlooked) EXPECT_LT((s.base - wood()[81].base).norm(), 0.01);
    if (s.change == Change::kept) EXPECT_NEAR(s.growth, 0.02, 0.006);
  }
}

TEST(Changes, SwappingTheSurveysTurnsGrowthAround) {
  std::vector<Tree> fewer = wood();
  fewer.erase(fewer.begin() + 20, fewer.begin() + 25);
  const Survey a = walk("a", wood(), 2, 22), b = walk("b", fewer, 4, 24);
  const auto there = changes(a, b, usual(), *make_context()),
             back = changes(b, a, usual(), *make_context());
  EXPECT_EQ(count(there, Change::gone), 5u);
  EXPECT_EQ(count(back, Change::overlooked), 5u);  // thick trees do not grow in between
  EXPECT_EQ(count(there, Change::kept), count(back, Change::kept));
  double sum = 0;
  for (const StemChange& s : there.stems)
    if (s.change == Change::kept) sum += s.growth;
  for (const StemChange& s : back.stems)
    if (s.change == Change::kept) sum += s.growth;
  EXPECT_NEAR(sum, 0, 1e-9);
}

// The second survey walks the southern half only.
TEST(Changes, APlaceNeverLookedAtIsNoChange) {
  const auto c =
      changes(walk("a", wood(), 2, 22), walk("b", wood(), 2, 4), usual(), *make_context());
  EXPECT_EQ(count(c, Change::gone), 0u);
  EXPECT_GT(count(c, Change::unsure), 20u);
  for (const StemChange& s : c.stems)
    if (s.change == Change::unsure) EXPECT_NE(s.reason, "");
  for (const CellChange& cell : c.cells)
    if (cell.ground) EXPECT_LT(cell.cell[1], 12);
}

TEST(Changes, GroundThatRoseIsSeen) {
  const auto c =
      changes(walk("a", wood(), 2, 22), walk("b", wood(), 2, 22, 0.3), usual(), *make_context());
  std::size_t seen = 0;
  for (const CellChange& cell : c.cells) {
    if (!cell.ground) continue;
    EXPECT_NEAR(*cell.ground, 0.3, 1e-5);
    ++seen;
  }
  EXPECT_GT(seen, 300u);
  for (const CellChange& cell : c.cells)
    if (cell.canopy) EXPECT_NEAR(*cell.canopy, 0, 1e-5);  // from the ground, nothing grew
}

// A crown at 12 m was there before. Where later rays pass that height it is gone; where none does,
// nothing is said.
TEST(Changes, ACrownIsGoneOnlyWhereRaysPassedItsHeight) {
  const std::vector<Vec3> crown{{5.5, 10.5, 12}, {15.5, 10.5, 12}};
  std::vector<Vec3> beyond;
  for (double y = 0; y < 24; y += 0.5) beyond.push_back({-20, y, 40});  // behind the first crown
  const Survey a = walk("a", wood(), 2, 22, 0, {}, crown);
  const Survey b = walk("b", wood(), 2, 22, 0, {}, beyond);
  const auto c = changes(a, b, usual(), *make_context());
  const auto at = [&](int x, int y) -> std::optional<double> {
    for (const CellChange& cell : c.cells)
      if (cell.cell == Cell{x, y}) return cell.canopy;
    return std::nullopt;
  };
  ASSERT_TRUE(at(5, 10));
  EXPECT_NEAR(*at(5, 10), -12, 0.01);
  EXPECT_FALSE(at(15, 10));
}

// Georeferenced apart, GNSS leaves 3 m and 2 degrees between the maps.
TEST(Changes, MapsAreBroughtTogetherByTheirTrees) {
  const GeoReference evo{61.2, 25.1, 130, {}, 0, 0};
  const SE3 T = SE3::from_yaw(0.7, {200, -50, 4}), off = SE3::from_yaw(0.035, {2.4, -1.8, 1});
  Survey a = walk("a", wood(), 2, 22), b = walk("b", wood(), 4, 24, 0, T);
  b.run.clear();
  a.clouds.islands[0].georeference = a.trees.islands[0].georeference = evo;
  GeoReference other = evo;
  other.T_map_enu = T * off;
  b.clouds.islands[0].georeference = b.trees.islands[0].georeference = other;
  const auto c = changes(a, b, usual(), *make_context());
  EXPECT_EQ(count(c, Change::kept), 100u);
  EXPECT_GT(c.aligned_by, 90u);
  EXPECT_LT(c.aligned_rms, 0.02);
  EXPECT_LT((c.T_before_after * T).log().norm(), 0.01);
}

TEST(Changes, SurveysWithoutACommonFrameAreRefused) {
  Survey a = walk("a", wood(), 2, 22), b = walk("b", wood(), 2, 22);
  b.run.clear();
  const auto refusal = [&](ErrorCode code) -> std::string {
    try {
      changes(a, b, usual(), *make_context());
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), code);
      return e.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal(ErrorCode::config).find("RUN:MISSION"), std::string::npos);
  const GeoReference evo{61.2, 25.1, 130, {}, 0, 0};
  for (Survey* s : {&a, &b}) s->clouds.islands[0].georeference = evo;
  const std::vector<Tree> all = wood();
  b = walk("b", {all.begin(), all.begin() + 3}, 2, 22);
  b.run.clear();
  b.clouds.islands[0].georeference = evo;
  EXPECT_NE(refusal(ErrorCode::check).find("do the surveys overlap"), std::string::npos);
}

TEST(Changes, AnyNumberOfThreadsGivesTheSameTables) {
  std::vector<Tree> fewer = wood();
  fewer.erase(fewer.begin() + 20, fewer.begin() + 25);
  const Survey a = walk("a", wood(), 2, 22), b = walk("b", fewer, 4, 24);
  const auto one = changes(a, b, usual(), *make_context(1)),
             four = changes(a, b, usual(), *make_context(4));
  EXPECT_EQ(stems_csv(a, one), stems_csv(a, four));
  EXPECT_EQ(cells_csv(a, one, 1), cells_csv(a, four, 1));
}

}  // namespace
}  // namespace cambium::monitor
