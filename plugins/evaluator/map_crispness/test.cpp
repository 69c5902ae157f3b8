// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>
#include <random>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

using Metrics = std::map<std::string, double>;

/// Flat ground seen from T_world_base, points strewn at random up to 10 m away.
Cloud ground(const SE3& T_world_base, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-10, 10);
  Cloud cloud;
  for (int i = 0; i < 8000; ++i) {
    const Vec3 p_world(T_world_base.t.x() + uniform(random), T_world_base.t.y() + uniform(random),
                       0);
    const Vec3 p = T_world_base.inverse() * p_world;
    for (int axis = 0; axis < 3; ++axis) cloud.xyz.push_back(float(p[axis]));
  }
  return cloud;
}

/// Missions a and b along the same 3 poses, in one island, at their true poses.
Atlas flat_world() {
  std::vector<Mission> missions;
  for (unsigned m = 0; m < 2; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(SE3::from_yaw(0.4 * i, {4.0 * i, 0.5 * m, 1.5}));
    missions.push_back(make_mission(m ? "b" : "a", poses));
    for (unsigned i = 0; i < 3; ++i)
      missions[m].nodes[i].payload = in_memory(ground(poses[i], 10 * m + i));
  }
  Atlas atlas = make_atlas(missions);
  atlas.islands = {{{0, 1}, {}}};
  atlas.missions[1].island = 0;
  return atlas;
}

Atlas moved(Atlas atlas, std::uint32_t mission, const SE3& T) {
  auto poses = *atlas.missions[mission].T_map_node;
  for (SE3& pose : poses) pose = T * pose;
  atlas.missions[mission].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  return atlas;
}

Metrics evaluate(const Atlas& atlas, const std::string& yaml = "{}",
                 const std::filesystem::path& reference = {}, int threads = 1) {
  Metrics out;
  for (const Metric& m : component<Evaluator>("map_crispness", yaml)
                             ->evaluate(atlas, reference, *make_context(threads)))
    EXPECT_TRUE(out.emplace(m.name, m.value).second) << m.name << " twice";
  return out;
}

void write_truth(const Atlas& atlas, const std::filesystem::path& folder) {
  for (const MissionState& state : atlas.missions) {
    std::vector<StampedPose> rows;
    for (const Node& node : state.mission->nodes)
      rows.push_back({*node.stamp, SE3::from_yaw(1, {7, 8, 9}) * node.T_mission_node});
    write_file(folder / (state.mission->name + ".tum"), format_tum(rows));
  }
}

TEST(MapCrispness, IsZeroForAnExactMap) {
  const Metrics m = evaluate(flat_world());
  EXPECT_LT(m.at("map_crispness.median"), 1e-5);
  EXPECT_EQ(m.at("map_crispness.pairs"), 7);  // |i - j| <= 1
  EXPECT_GT(m.at("map_crispness.overlap"), 0.7);
}

// Lifting one mission by d puts every point d off the other's ground.
TEST(MapCrispness, MeasuresAKnownBend) {
  for (const double d : {0.05, 0.2}) {
    const Metrics m = evaluate(moved(flat_world(), 1, SE3::from_yaw(0, {0, 0, d})));
    EXPECT_NEAR(m.at("map_crispness.median"), d, 1e-4);
    EXPECT_NEAR(m.at("map_crispness.worst"), d, 1e-4);
  }
}

TEST(MapCrispness, LosesOverlapWhenTheMapFallsApart) {
  const Metrics m = evaluate(moved(flat_world(), 1, SE3::from_yaw(0, {0, 0, 2})));
  EXPECT_EQ(m.at("map_crispness.overlap"), 0);
  EXPECT_EQ(m.at("map_crispness.pairs"), 0);
  EXPECT_EQ(m.count("map_crispness.median"), 0u);
}

TEST(MapCrispness, ComparesWithTheTruth) {
  const TemporaryFolder folder;
  Atlas atlas = flat_world();
  // The scans know better than this truth, which puts b 0.1 m too low.
  Mission b = *atlas.missions[1].mission;
  for (Node& node : b.nodes) node.T_mission_node.t.z() -= 0.1;
  atlas.missions[1].mission = std::make_shared<const Mission>(b);
  write_truth(atlas, folder.path());
  const Metrics m = evaluate(moved(atlas, 1, SE3::from_yaw(0, {0, 0, 0.05})), "{}", folder.path());
  EXPECT_NEAR(m.at("map_crispness.truth.median"), 0.1, 1e-4);
  EXPECT_NEAR(m.at("map_crispness.ratio"), 0.5, 1e-3);
}

TEST(MapCrispness, JudgesABentMapByTheSamePairsAsTheTruth) {
  const TemporaryFolder folder;
  const Atlas atlas = flat_world();
  write_truth(atlas, folder.path());
  const SE3 far = SE3::from_yaw(0, {0, 8, 0.1});  // along the ground: the scans still overlap
  const Metrics m = evaluate(moved(atlas, 1, far), "{}", folder.path());
  EXPECT_EQ(m.at("map_crispness.pairs"), 7);
  EXPECT_NEAR(m.at("map_crispness.median"), 0.1, 1e-4);
}

TEST(MapCrispness, ThinsPairsEvenlyAndIgnoresNeighboursAlongThePath) {
  EXPECT_EQ(evaluate(flat_world(), "{max_pairs: 3}").at("map_crispness.pairs"), 3);
  EXPECT_EQ(evaluate(flat_world(), "{min_path: 3}").at("map_crispness.pairs"), 7 + 4);
}

TEST(MapCrispness, AnyNumberOfThreadsGivesTheSameFigures) {
  const Atlas atlas = moved(flat_world(), 1, SE3::from_yaw(0.01, {0.1, 0, 0.03}));
  EXPECT_EQ(evaluate(atlas), evaluate(atlas, "{}", {}, 4));
}

TEST(MapCrispness, TakesCloudsThatSayNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& xyz : {std::vector<float>{}, std::vector<float>{nan, 0, 0},
                                        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}}) {
    Cloud cloud;
    cloud.xyz = xyz;
    Mission a = make_mission("a", {SE3{}}), b = make_mission("b", {SE3{}});
    a.nodes[0].payload = b.nodes[0].payload = in_memory(cloud);
    Atlas atlas = make_atlas({a, b});
    atlas.islands = {{{0, 1}, {}}};
    atlas.missions[1].island = 0;
    EXPECT_EQ(evaluate(atlas).at("map_crispness.pairs"), 0);
  }
}

}  // namespace
}  // namespace cambium::testing
