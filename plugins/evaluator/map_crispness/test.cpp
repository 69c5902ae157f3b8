// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <random>

#include "support/maps.hpp"

namespace cambium::testing {
namespace {

using Metrics = std::map<std::string, double>;

constexpr double density = 20;  // points a square metre of ground

/// A scan that is put together in the world frame and kept in the base frame.
class Scan {
 public:
  Scan(const SE3& T_world_base, unsigned seed) : T_world_base_(T_world_base), random_(seed) {}

  void add(const Vec3& p_world) {
    const Vec3 p = T_world_base_.inverse() * p_world;
    for (int axis = 0; axis < 3; ++axis) cloud.xyz.push_back(float(p[axis]));
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Flat, up to 10 m away, points strewn at random.
  void ground() {
    for (int i = 0; i < int(density * 400); ++i)
      add({T_world_base_.t.x() + uniform(-10, 10), T_world_base_.t.y() + uniform(-10, 10), 0});
  }
  /// The side of a stem that faces west, as a lidar's rings meet it.
  void stem(double x, double y) {
    for (double z = uniform(0.5, 0.8); z < 6; z += 0.3)
      for (const double angle : {-0.5, 0.0, 0.5})
        add({x - 0.1 * std::cos(angle), y + 0.1 * std::sin(angle), z});
  }
  /// A crown: other points for every scan.
  void leaves() {
    for (int i = 0; i < 4000; ++i) add({uniform(-5, 15), uniform(-6, 6), uniform(2, 6)});
  }

  Cloud cloud;

 private:
  SE3 T_world_base_;
  std::mt19937 random_;
};

/// Missions a and b along the same 3 poses, in one island, at their true poses. `fill` adds what a
/// scan saw.
template <class Fill>
Atlas world(Fill fill) {
  std::vector<Mission> missions;
  for (unsigned m = 0; m < 2; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(SE3::from_yaw(0.4 * i, {4.0 * i, 0.5 * m, 1.5}));
    missions.push_back(make_mission(m ? "b" : "a", poses));
    for (unsigned i = 0; i < 3; ++i) {
      Scan scan(poses[i], 10 * m + i);
      fill(scan);
      missions[m].nodes[i].payload = in_memory(scan.cloud);
    }
  }
  return tied(make_atlas(missions));
}

Atlas flat_world() {
  return world([](Scan& scan) { scan.ground(); });
}

Metrics crispness(const Atlas& atlas, const std::string& yaml = "{}",
                  const std::filesystem::path& reference = {}, int threads = 1) {
  return evaluate("map_crispness", atlas, reference, yaml, threads);
}

TEST(MapCrispness, IsZeroForAnExactMap) {
  const Metrics m = crispness(flat_world());
  EXPECT_LT(m.at("map_crispness.median"), 1e-5);
  EXPECT_EQ(m.at("map_crispness.pairs"), 7);  // |i - j| <= 1
  EXPECT_GT(m.at("map_crispness.overlap"), 0.7);
}

// Lifting one mission by d puts every point d off the other's ground.
TEST(MapCrispness, MeasuresAKnownBend) {
  for (const double d : {0.05, 0.2}) {
    const Metrics m = crispness(moved(flat_world(), 1, SE3::from_yaw(0, {0, 0, d})));
    EXPECT_NEAR(m.at("map_crispness.median"), d, 1e-4);
    EXPECT_NEAR(m.at("map_crispness.worst"), d, 1e-4);
  }
}

// Two sheets d apart instead of one: the vertical variance grows from the noise floor to that of
// two values, and the other sheet's disc in a ball around a point is narrower.
TEST(MapCrispness, EntropyGrowsByAKnownAmount) {
  const double radius = 0.7, d = 0.2, noise = 0.01;
  const std::string yaml = "{entropy_radius: 0.7}";
  const auto entropy = [&](double lift) {
    return crispness(moved(flat_world(), 1, SE3::from_yaw(0, {0, 0, lift})), yaml)
        .at("map_crispness.entropy");
  };
  const double own = radius * radius, other = own - d * d, share = own / (own + other);
  const double vertical = share * (1 - share) * d * d + noise * noise;
  const double horizontal = share * own + (1 - share) * other;
  const double expected = 0.5 * std::log(vertical / (noise * noise)) + std::log(horizontal / own);
  EXPECT_NEAR(entropy(d) - entropy(0), expected, 0.06);  // few points a ball
}

TEST(MapCrispness, SeesAShiftOfStemsThatTheGroundDoesNotShow) {
  const Atlas atlas = world([](Scan& scan) {
    scan.ground();
    for (const double y : {-4.0, -1.0, 2.0, 5.0}) scan.stem(7, y), scan.stem(11, y);
  });
  for (const double d : {0.0, 0.06}) {
    const Metrics m = crispness(moved(atlas, 1, SE3::from_yaw(0, {d, 0, 0})), "{voxel_size: 0.2}");
    EXPECT_NEAR(m.at("map_crispness.upright"), d, 0.012);  // the face of a stem is no plane
    EXPECT_LT(m.at("map_crispness.ground"), 1e-5);
  }
}

TEST(MapCrispness, LeavesChangeNothing) {
  const Atlas atlas = world([](Scan& scan) {
    scan.ground();
    scan.leaves();
  });
  const Metrics m = crispness(moved(atlas, 1, SE3::from_yaw(0, {0, 0, 0.1})));
  EXPECT_NEAR(m.at("map_crispness.median"), 0.1, 1e-3);
  EXPECT_NEAR(m.at("map_crispness.ground"), 0.1, 1e-4);
}

TEST(MapCrispness, LosesOverlapWhenTheMapFallsApart) {
  const Metrics m = crispness(moved(flat_world(), 1, SE3::from_yaw(0, {0, 0, 2})));
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
  const Metrics m = crispness(moved(atlas, 1, SE3::from_yaw(0, {0, 0, 0.05})), "{}", folder.path());
  EXPECT_NEAR(m.at("map_crispness.truth.median"), 0.1, 1e-4);
  EXPECT_NEAR(m.at("map_crispness.ratio"), 0.5, 1e-3);
}

TEST(MapCrispness, JudgesABentMapByTheSamePairsAsTheTruth) {
  const TemporaryFolder folder;
  const Atlas atlas = flat_world();
  write_truth(atlas, folder.path());
  const SE3 far = SE3::from_yaw(0, {0, 8, 0.1});  // along the ground: the scans still overlap
  const Metrics m = crispness(moved(atlas, 1, far), "{}", folder.path());
  EXPECT_EQ(m.at("map_crispness.pairs"), 7);
  EXPECT_NEAR(m.at("map_crispness.median"), 0.1, 1e-4);
}

TEST(MapCrispness, ThinsPairsEvenlyAndIgnoresNeighboursAlongThePath) {
  EXPECT_EQ(crispness(flat_world(), "{max_pairs: 3}").at("map_crispness.pairs"), 3);
  EXPECT_EQ(crispness(flat_world(), "{min_path: 3}").at("map_crispness.pairs"), 7 + 4);
}

TEST(MapCrispness, AnyNumberOfThreadsGivesTheSameFigures) {
  const Atlas atlas = moved(flat_world(), 1, SE3::from_yaw(0.01, {0.1, 0, 0.03}));
  EXPECT_EQ(crispness(atlas), crispness(atlas, "{}", {}, 4));
}

TEST(MapCrispness, TakesCloudsThatSayNothing) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const std::vector<float>& xyz : {std::vector<float>{}, std::vector<float>{nan, 0, 0},
                                        std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1}}) {
    Cloud cloud;
    cloud.xyz = xyz;
    Mission a = make_mission("a", {SE3{}}), b = make_mission("b", {SE3{}});
    a.nodes[0].payload = b.nodes[0].payload = in_memory(cloud);
    EXPECT_EQ(crispness(tied(make_atlas({a, b}))).at("map_crispness.pairs"), 0);
  }
}

}  // namespace
}  // namespace cambium::testing
