// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Cloud points(std::vector<float> xyz) {
  Cloud cloud;
  cloud.xyz = std::move(xyz);
  return cloud;
}

/// Missions through one forest, in one island.
Atlas forest(int missions = 2, std::size_t per_scan = 5000) {
  std::vector<Mission> all;
  for (int m = 0; m < missions; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(SE3::from_yaw(0.3 * i, {4.0 * i, 2.0 * m, 1}));
    all.push_back(make_mission(std::string(1, char('a' + m)), poses));
    for (Node& node : all.back().nodes)
      node.payload = in_memory(forest_scan(node.T_mission_node, 1, per_scan));
  }
  Atlas atlas = make_atlas(all);
  atlas.islands = {Island{}};
  for (std::uint32_t m = 0; m < std::uint32_t(missions); ++m) {
    atlas.missions[m].island = 0;
    atlas.islands[0].missions.push_back(m);
  }
  return atlas;
}

std::vector<fs::path> write(const Atlas& atlas, const fs::path& folder,
                            const std::string& yaml = "{}", int threads = 1) {
  return component<MapExporter>("web_view", yaml)->write(atlas, folder, *make_context(threads));
}

Json map_of(const fs::path& folder) { return Json::parse(read_file(folder / "map.json")); }

struct Read {
  Vec3 p;
  std::uint32_t node = 0;
  int intensity = 0;
};

/// Every point of every tile of an island, as docs/view.md says that they are written.
std::vector<Read> read_points(const fs::path& folder, std::size_t island = 0) {
  const Json tree = map_of(folder)["islands"][island]["points"];
  std::vector<Read> out;
  for (const auto& [name, count] : tree["tiles"].items()) {
    Vec3 low(tree["low"][0], tree["low"][1], tree["low"][2]);
    double width = tree["width"];
    for (const char digit : name.substr(1)) {
      width /= 2;
      for (int a = 0; a < 3; ++a) low[a] += width * double((digit - '0') >> (2 - a) & 1);
    }
    const std::size_t n = count;
    const fs::path file = folder / tree["folder"].get<std::string>() / (name + ".bin");
    EXPECT_EQ(fs::exists(file), n > 0) << file;
    if (n == 0) continue;
    const std::string bytes = read_file(file);
    EXPECT_EQ(bytes.size(), 12 * n) << file;
    std::vector<std::uint16_t> front(4 * n);
    std::vector<std::uint32_t> nodes(n);
    std::memcpy(front.data(), bytes.data(), 8 * n);
    std::memcpy(nodes.data(), bytes.data() + 8 * n, 4 * n);
    const double unit = tree["unit"], step = std::max(unit, width / 65536);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 steps(front[4 * i], front[4 * i + 1], front[4 * i + 2]);
      out.push_back({low + step * steps + Vec3::Constant((step - unit) / 2), nodes[i],
                     front[4 * i + 3] & 255});
    }
  }
  EXPECT_EQ(out.size(), tree["points"].get<std::size_t>());
  return out;
}

/// Millimetres and node, for comparing sets of points.
using Place = std::array<long, 4>;
std::vector<Place> places(std::vector<Read> read, double grid) {
  std::vector<Place> out;
  for (const Read& r : read)
    out.push_back({std::lround(r.p.x() / grid), std::lround(r.p.y() / grid),
                   std::lround(r.p.z() / grid), long(r.node)});
  std::sort(out.begin(), out.end());
  return out;
}

std::vector<Read> of_atlas(const Atlas& atlas) {
  std::vector<Read> out;
  std::uint32_t number = 0;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m)
    for (std::uint32_t n = 0; n < atlas.missions[m].mission->nodes.size(); ++n, ++number) {
      const auto cloud = atlas.payload({m, n}).cloud;
      for (Eigen::Index i = 0; cloud && i < cloud->points().cols(); ++i)
        out.push_back({atlas.T_map_node({m, n}) * Vec3(cloud->points().col(i).cast<double>()), number});
    }
  return out;
}

// Each point of the clouds is matched with one of the tiles: sorted by node and distance.
TEST(WebView, EveryPointIsInOneTileWithinACentimetre) {
  const TemporaryFolder folder;
  const Atlas atlas = forest();
  write(atlas, folder.path(), "{voxel_size: 0, tile_points: 500}");
  const auto expected = of_atlas(atlas);
  auto found = read_points(folder.path());
  ASSERT_EQ(found.size(), expected.size());
  EXPECT_GT(map_of(folder.path())["islands"][0]["points"]["tiles"].size(), 20u);
  // Buckets of 5 cm; a point's partner lies in its own or a neighbouring one.
  std::map<Place, std::vector<std::size_t>> buckets;
  for (std::size_t i = 0; i < found.size(); ++i)
    buckets[places({found[i]}, 0.05)[0]].push_back(i);
  std::vector<bool> used(found.size());
  for (const Read& want : expected) {
    const Place at = places({want}, 0.05)[0];
    std::size_t best = found.size();
    for (long k = 0; k < 27; ++k) {
      const auto bucket = buckets.find({at[0] + k / 9 - 1, at[1] + k / 3 % 3 - 1, at[2] + k % 3 - 1, at[3]});
      if (bucket == buckets.end()) continue;
      for (const std::size_t i : bucket->second)
        if (!used[i] && (best == found.size() ||
                         (found[i].p - want.p).norm() < (found[best].p - want.p).norm()))
          best = i;
    }
    ASSERT_LT(best, found.size());
    ASSERT_LT((found[best].p - want.p).cwiseAbs().maxCoeff(), 0.005);
    used[best] = true;
  }
}

TEST(WebView, ACoarseTileIsAnEvenSampleOfAllMissions) {
  const TemporaryFolder folder;
  write(forest(2, 20000), folder.path(), "{voxel_size: 0, tile_points: 2000}");
  const Json tree = map_of(folder.path())["islands"][0]["points"];
  const std::size_t root = tree["tiles"]["r"];
  EXPECT_GT(root, 500u);
  EXPECT_LT(root, tree["points"].get<std::size_t>() / 2);
  const std::string bytes = read_file(folder / "tiles/0/r.bin");
  std::set<std::array<int, 3>> voxels;
  std::size_t of_first = 0;
  for (std::size_t i = 0; i < root; ++i) {
    std::uint16_t v[3];
    std::uint32_t node;
    std::memcpy(v, bytes.data() + 8 * i, 6);
    std::memcpy(&node, bytes.data() + 8 * root + 4 * i, 4);
    of_first += node < 3;
    const double unit = tree["unit"], width = tree["width"], step = std::max(unit, width / 65536);
    const auto voxel = [&](int a) { return int(v[a] * step / width * 64); };
    EXPECT_TRUE(voxels.insert({voxel(0), voxel(1), voxel(2)}).second);
  }
  EXPECT_NEAR(double(of_first) / double(root), 0.5, 0.1);
}

TEST(WebView, TheBytesDoNotDependOnThreads) {
  const TemporaryFolder one, four;
  const Atlas atlas = forest(3, 3000);
  const auto a = write(atlas, one.path(), "{tile_points: 1000}", 1);
  const auto b = write(atlas, four.path(), "{tile_points: 1000}", 4);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(fs::relative(a[i], one.path()), fs::relative(b[i], four.path()));
    EXPECT_TRUE(read_file(a[i]) == read_file(b[i])) << a[i];
  }
}

TEST(WebView, AVoxelKeepsOnePointOfEachMission) {
  const TemporaryFolder folder;
  std::vector<Mission> missions;
  for (const char* name : {"a", "b"}) {
    missions.push_back(make_mission(name, {SE3{}, SE3{}}));
    for (Node& node : missions.back().nodes)
      node.payload = in_memory(points({0.01f, 0.01f, 0.01f, 0.02f, 0.02f, 0.02f, 3, 3, 3}));
  }
  Atlas atlas = make_atlas(missions);
  atlas.islands = {{{0, 1}, {}}};
  atlas.missions[1].island = 0;
  write(atlas, folder.path(), "{voxel_size: 0.1}");
  std::vector<std::uint32_t> nodes;
  for (const Read& r : read_points(folder.path())) nodes.push_back(r.node);
  std::sort(nodes.begin(), nodes.end());
  EXPECT_EQ(nodes, (std::vector<std::uint32_t>{0, 0, 2, 2}));  // the first node of each mission
}

TEST(WebView, NodesAreCountedInTheOrderOfMissions) {
  const TemporaryFolder folder;
  write(forest(), folder.path());
  const Json map = map_of(folder.path());
  EXPECT_EQ(map["missions"][0]["name"], "a");
  EXPECT_EQ(map["missions"][1]["name"], "b");
  ASSERT_EQ(map["stages"].size(), 2u);
  EXPECT_EQ(map["stages"][0]["name"], "odometry");
  const Json& poses = map["stages"][1]["poses"];
  ASSERT_EQ(poses.size(), 7u * 6);
  EXPECT_DOUBLE_EQ(poses[7 * 3 + 1], 2.0);  // y of the first node of b
}

TEST(WebView, EachOptimisationIsAStage) {
  const TemporaryFolder folder;
  Atlas atlas = forest();
  const auto poses = [&](std::uint32_t m, const SE3& T) {
    std::vector<SE3> out;
    for (const SE3& pose : *atlas.missions[m].T_map_node) out.push_back(T * pose);
    return std::make_shared<const std::vector<SE3>>(out);
  };
  // First, b was an island of its own, whose frame lay elsewhere; it bent when it was joined.
  const SE3 bend = SE3::from_yaw(0.2);
  auto bent = std::vector<SE3>(*atlas.missions[1].T_map_node);
  bent.back() = bent.back() * bend;
  Stage first{"somebody", {atlas.missions[0].T_map_node, nullptr}, {0, 1}};
  const SE3 elsewhere = SE3::from_yaw(1, {100, 200, 3});
  for (SE3& T : bent) T = elsewhere * T;
  first.T_map_node[1] = std::make_shared<const std::vector<SE3>>(bent);
  Stage last{"another", {atlas.missions[0].T_map_node, atlas.missions[1].T_map_node}, {0, 0}};
  atlas.stages = {first, last};
  write(atlas, folder.path());
  const Json stages = map_of(folder.path())["stages"];
  ASSERT_EQ(stages.size(), 3u);  // what the last optimisation left is the map
  EXPECT_EQ(stages[1]["name"], "somebody");
  const Json &then = stages[1]["poses"], &now = stages[2]["poses"];
  for (std::size_t k = 0; k < 7 * 5; ++k)
    EXPECT_NEAR(then[k].get<double>(), now[k].get<double>(), 2e-4) << k;
  EXPECT_GT(std::abs(then[7 * 5 + 5].get<double>() - now[7 * 5 + 5].get<double>()), 0.05);
  atlas.stages = {last, first};  // georeferencing moved the map since
  write(atlas, folder.path());
  EXPECT_EQ(map_of(folder.path())["stages"].size(), 4u);
}

TEST(WebView, LabelsGoAlong) {
  const TemporaryFolder folder;
  Cloud cloud = points({0, 0, 0, 1, 0, 0});
  cloud.label = {2, 66};
  Mission mission = make_mission("a", {SE3{}});
  mission.nodes[0].payload = in_memory(cloud);
  write(make_atlas({mission}), folder.path());
  const std::string bytes = read_file(folder / "tiles/0/r.bin");
  EXPECT_EQ(std::uint8_t(bytes[7]), 2);
  EXPECT_EQ(std::uint8_t(bytes[15]), 66);
}

TEST(WebView, IntensitiesFillTheRange) {
  const TemporaryFolder folder;
  Cloud cloud = points({});
  for (int i = 0; i < 1000; ++i) {
    cloud.xyz.insert(cloud.xyz.end(), {float(i), 0, 0});
    cloud.intensity.push_back(float(100 + 60 * i));  // a sensor that counts to 60 000
  }
  Mission mission = make_mission("a", {SE3{}});
  mission.nodes[0].payload = in_memory(cloud);
  write(make_atlas({mission}), folder.path());
  auto read = read_points(folder.path());
  std::ranges::sort(read, {}, [](const Read& r) { return r.p.x(); });
  EXPECT_LT(read[5].intensity, 5);
  EXPECT_NEAR(read[500].intensity, 127, 5);
  EXPECT_EQ(read[995].intensity, 255);
  EXPECT_TRUE(map_of(folder.path())["islands"][0]["intensity"].is_array());
}

Loop loop(NodeRef tail, NodeRef head, LoopState state) {
  Loop out;
  out.tail = tail;
  out.head = head;
  out.state = state;
  out.proposed_by = "somebody";
  out.registered_by = "icp";
  out.decided_by = state == LoopState::accepted ? "judge" : "icp";
  out.scores = {{"overlap", 0.75}};
  return out;
}

TEST(WebView, LoopsHaveTheirRowAndBothClouds) {
  const TemporaryFolder folder;
  Atlas atlas = forest();
  atlas.loops = {loop({0, 0}, {1, 0}, LoopState::accepted), loop({0, 1}, {1, 2}, LoopState::rejected)};
  write(atlas, folder.path(), "{pair_points: 1000}");
  const Json map = map_of(folder.path()), rows = map["loops"]["rows"], strings = map["loops"]["strings"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0][1], 3);
  EXPECT_EQ(strings[rows[0][2].get<int>()], "accepted");
  EXPECT_EQ(rows[0][8].size(), 7u);
  EXPECT_TRUE(rows[1][8].is_null());  // it did not converge
  EXPECT_EQ(strings[rows[0][9][0].get<int>()], "overlap");
  EXPECT_EQ(map["islands"][0]["pairs"], Json({0, 1, 3, 5}));
  const std::string bytes = read_file(folder / "pairs/0.bin");
  EXPECT_NEAR(double(bytes.size()) / 6, 1000, 120);
  std::int16_t cm[3];
  std::memcpy(cm, bytes.data(), sizeof cm);
  const auto cloud = atlas.payload({0, 0}).cloud;
  double least = 1e9;
  for (Eigen::Index i = 0; i < cloud->points().cols(); ++i)
    least = std::min<double>(least, (100 * cloud->points().col(i) - Eigen::Vector3f(cm[0], cm[1], cm[2])).cwiseAbs().maxCoeff());
  EXPECT_LE(least, 0.51);
}

TEST(WebView, SightingsOfOneTreeAreOneStem) {
  const TemporaryFolder folder;
  Mission mission = make_mission("a", {SE3{}, SE3::from_yaw(1.0, {5, 0, 0}), SE3{}});
  const Vec3 tree(3, 4, -1);
  const double diameters[] = {0.30, 0.34, 0.20};
  for (int i = 0; i < 3; ++i) {
    const SE3 T = mission.nodes[std::size_t(i)].T_mission_node.inverse();
    std::vector<Tree> trees = {{T * (tree + Vec3(0.05 * i, 0, 0)), T.q * Vec3::UnitZ(), diameters[i], 1, true}};
    if (i == 2) trees.push_back({{20, 20, 0}, Vec3::UnitZ(), 0.3, 1, true});  // seen once
    mission.nodes[std::size_t(i)].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(trees)});
  }
  write(make_atlas({mission}), folder.path());
  const Json stems = map_of(folder.path())["stems"];
  ASSERT_EQ(stems.size(), 1u);
  EXPECT_EQ(stems[0]["sightings"], 3);
  EXPECT_NEAR(stems[0]["base"][0].get<double>(), 3.05, 0.001);
  EXPECT_NEAR(stems[0]["dbh"].get<double>(), 0.3, 0.05);
  EXPECT_EQ(stems[0]["missions"], Json({0}));
}

TEST(WebView, PicturesOfAMissionLieAtItsNodes) {
  const TemporaryFolder folder, recording;
  write_file(recording / "left.jpg", "a picture");
  Mission mission = make_mission("a", {SE3{}, SE3{}});
  Payload payload;
  payload.images = std::make_shared<const std::vector<Image>>(
      std::vector<Image>{{recording / "left.jpg", "cam0"}, {recording / "right.jpg", "cam1"}});
  mission.nodes[1].payload = in_memory(payload);
  write(make_atlas({mission}), folder.path());
  EXPECT_EQ(map_of(folder.path())["images"], Json::parse(R"([[1,"images/1.jpg"]])"));
  EXPECT_EQ(read_file(folder / "images/1.jpg"), "a picture");
  write(make_atlas({mission}), folder.path(), "{images: false}");
  EXPECT_FALSE(fs::exists(folder / "images"));
}

TEST(WebView, WhatIsNoPointIsLeftOut) {
  const TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  Mission mission = make_mission("a", {SE3{}, SE3{}, SE3{}});
  mission.nodes[0].payload = in_memory(points({}));
  mission.nodes[1].payload = in_memory(points({nan, 0, 0, 1e30f, 0, 0, 1, 2, 3, -400000, 9, 9}));
  write(make_atlas({mission}), folder.path());
  EXPECT_EQ(read_points(folder.path()).size(), 2u);  // 400 km away is a long way, but a place
}

TEST(WebView, APageOfAnEarlierMapLeavesNothing) {
  const TemporaryFolder folder;
  write(forest(3, 4000), folder.path(), "{tile_points: 300}");
  const auto files = write(forest(1, 1000), folder.path());
  std::size_t there = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    there += entry.is_regular_file();
  EXPECT_EQ(there, files.size() + 1);  // layers.json is no part of the export
  EXPECT_EQ(files.back().filename(), "map.json");  // the last one: without it the page is not whole
}

TEST(WebView, ThePageIsThereWithoutClouds) {
  const TemporaryFolder folder;
  const auto files = write(make_atlas({make_mission("a", {SE3{}})}), folder.path());
  EXPECT_EQ(files.size(), 4u);
  EXPECT_EQ(map_of(folder.path())["islands"][0]["points"]["points"], 0);
  const std::string page = read_file(folder / "page.js");
  EXPECT_NE(page.find("SPDX-License-Identifier: MIT"), std::string::npos);  // three.js keeps its notice
  EXPECT_EQ(read_file(folder / "index.html").find("http://"), std::string::npos);
}

}  // namespace
}  // namespace cambium::testing
