// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/projection.hpp"
#include "cambium/stems.hpp"
#include "support/maps.hpp"

namespace cambium::testing {
namespace {

const GeoReference evo{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};

Tree tree(const Vec3& base, double dbh) {
  Tree t;
  t.base = base;
  t.dbh = dbh;
  t.score = 0.8;
  t.reconstructed = true;
  return t;
}

/// A mission whose every node sees these trees of the world from where it stands, each time a
/// little beside, and measures their diameters a little wrong.
Mission looking_at(const std::string& name, const std::vector<SE3>& poses,
                   const std::vector<Tree>& world) {
  Mission mission = make_mission(name, poses);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    std::vector<Tree> seen = world;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const double beside = 0.03 * std::sin(7.0 * double(n) + double(k) + poses[n].t.y());
      seen[k].base = poses[n].inverse() * (world[k].base + Vec3(beside, -beside, 0));
      seen[k].dbh += beside / 3;
    }
    mission.nodes[n].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(seen)});
  }
  return mission;
}

std::vector<SE3> walk(double y) {
  std::vector<SE3> poses;
  for (int i = 0; i < 6; ++i) poses.push_back(SE3::from_yaw(0.3 * i, {2.0 * i, y, 1}));
  return poses;
}

std::vector<Tree> wood() {
  std::vector<Tree> trees;
  for (int i = 0; i < 30; ++i)
    trees.push_back(tree({1.5 * (i % 6), 1.7 * (i / 6), 0.1 * i}, 0.15 + 0.01 * i));
  return trees;
}

Atlas two_missions(const char* first = "a", const char* second = "b") {
  const Mission one = looking_at(first, walk(1), wood()), two = looking_at(second, walk(6), wood());
  Atlas atlas = std::string(first) < second ? make_atlas({one, two}) : make_atlas({two, one});
  atlas = tied(atlas);
  atlas.islands[0].georeference = evo;
  return atlas;
}

std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                         const std::string& yaml = "{}", int threads = 1) {
  return component<MapExporter>("inventory", yaml)->write(atlas, folder, *make_context(threads));
}

std::vector<std::vector<std::string>> table(const std::filesystem::path& file) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(read_file(file));
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    auto& row = rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
  }
  return rows;
}

TEST(Inventory, EveryTreeOnceWithWhereAndHowThick) {
  const TemporaryFolder folder;
  const Atlas atlas = two_missions();
  const auto files = write(atlas, folder.path(), "{crs: 'EPSG:32635'}");
  ASSERT_EQ(files.size(), 2u);
  const auto rows = table(files[0]);
  ASSERT_EQ(rows.size(), 31u);
  EXPECT_EQ(rows[0][10], "dbh");
  const Projection grid("EPSG:32635");
  for (const Tree& t : wood()) {
    const auto row = std::find_if(rows.begin() + 1, rows.end(), [&](const auto& r) {
      return std::hypot(std::stod(r[2]) - t.base.x(), std::stod(r[3]) - t.base.y()) < 0.1;
    });
    ASSERT_NE(row, rows.end());
    EXPECT_NEAR(std::stod((*row)[10]), t.dbh, 0.01);
    EXPECT_EQ((*row)[15], "12");
    EXPECT_EQ((*row)[16], "a;b");
    const Vec3 p(std::stod((*row)[2]), std::stod((*row)[3]), std::stod((*row)[4]));
    const Vec3 q = grid(map_to_geodetic(evo, p));
    EXPECT_NEAR(std::stod((*row)[5]), q.x(), 2e-3);
    EXPECT_NEAR(std::stod((*row)[6]), q.y(), 2e-3);
  }
  const auto json = nlohmann::json::parse(read_file(files[1]));
  ASSERT_EQ(json.at("features").size(), 30u);
  EXPECT_EQ(json["features"][0]["properties"]["missions"], "a;b");
  EXPECT_NEAR(json["features"][0]["geometry"]["coordinates"][1].get<double>(), 61.2, 1e-3);
}

// The same recordings under other names stand in another order in the atlas.
TEST(Inventory, OrderOfMissionsAndThreadsChangeNothing) {
  const TemporaryFolder one, two, four;
  std::string ab = read_file(write(two_missions("a", "b"), one.path())[0]);
  std::string ba = read_file(write(two_missions("z", "b"), two.path())[0]);
  EXPECT_EQ(ab, read_file(write(two_missions("a", "b"), four.path(), "{}", 4)[0]));
  for (std::size_t at; (at = ab.find("a;b")) != ab.npos;) ab.replace(at, 3, "both");
  for (std::size_t at; (at = ba.find("b;z")) != ba.npos;) ba.replace(at, 3, "both");
  EXPECT_EQ(ab, ba);
}

TEST(Inventory, GroupsDependOnPlacesOnly) {
  std::vector<Vec3> places;
  for (int i = 0; i < 200; ++i)
    places.push_back({std::fmod(0.37 * i * i, 5.0), std::fmod(0.61 * i, 4.0), 0});
  const auto groups = plan_groups(places, 0.5);
  std::size_t members = 0;
  for (const auto& group : groups) members += group.size();
  EXPECT_EQ(members, places.size());
  const std::vector<Vec3> turned(places.rbegin(), places.rend());
  auto again = plan_groups(turned, 0.5);
  for (auto& group : again) {
    for (std::size_t& i : group) i = places.size() - 1 - i;
    std::sort(group.begin(), group.end());
  }
  EXPECT_EQ(groups, again);
}

TEST(Inventory, OneGrossDiameterMovesLittle) {
  std::vector<Tree> one{tree({3, 3, 0}, 0.3)};
  Mission a = looking_at("a", walk(1), one);
  one[0].dbh = 3;  // a circle through a bush
  a.nodes[2].payload = in_memory(
      Payload{nullptr, std::make_shared<const std::vector<Tree>>(std::vector{
                           tree(a.nodes[2].T_mission_node.inverse() * one[0].base, one[0].dbh)})});
  const auto stems = stems_of(make_atlas({a}), {0}, {}, *make_context());
  ASSERT_EQ(stems.size(), 1u);
  EXPECT_NEAR(stems[0].dbh, 0.3, 0.01);
  EXPECT_GT(stems[0].dbh_spread, 0.5);
}

TEST(Inventory, SightingsAndModelsDecideWhatIsATree) {
  const TemporaryFolder folder;
  EXPECT_TRUE(write(two_missions(), folder.path(), "{min_sightings: 13}").empty());
  std::vector<Tree> doubtful = wood();
  for (Tree& t : doubtful) t.reconstructed = false;
  const Atlas atlas = make_atlas({looking_at("a", walk(1), doubtful)});
  EXPECT_TRUE(write(atlas, folder.path()).empty());
  const auto files = write(atlas, folder.path(), "{only_reconstructed: false}");
  ASSERT_EQ(files.size(), 1u);  // no georeference, no GeoJSON
  const auto rows = table(files[0]);
  ASSERT_EQ(rows.size(), 31u);
  EXPECT_EQ(rows[1][5], "");
  EXPECT_EQ(read_file(files[0]).rfind("# crs: none", 0), 0u);
}

TEST(Inventory, UnknownDiametersAreEmpty) {
  const TemporaryFolder folder;
  const Tree t = tree({3, 3, 0}, std::numeric_limits<double>::quiet_NaN());
  Atlas atlas = make_atlas({looking_at("a", walk(1), {t})});
  atlas.islands[0].georeference = evo;
  const auto files = write(atlas, folder.path());
  EXPECT_EQ(table(files.at(0)).at(1)[10], "");
  const auto json = nlohmann::json::parse(read_file(files.at(1)));
  EXPECT_TRUE(json["features"][0]["properties"]["dbh"].is_null());
}

TEST(Inventory, RefusesSystemsInDegreesOrUnknown) {
  const TemporaryFolder folder;
  for (const char* crs : {"EPSG:999999", "EPSG:4326"})
    EXPECT_THROW(write(two_missions(), folder.path(), std::string("{crs: '") + crs + "'}"), Error);
}

}  // namespace
}  // namespace cambium::testing
