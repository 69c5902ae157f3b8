// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr double degree = std::numbers::pi / 180;
const Geodetic place{61.2, 25.1, 130.0};

/// `n` nodes `step` metres apart on a bent path, one a second.
std::vector<SE3> path(int n, double step, double bend = 0.02) {
  std::vector<SE3> poses{SE3{}};
  for (int i = 1; i < n; ++i) poses.push_back(poses.back() * SE3::from_yaw(bend, {step, 0, 0}));
  return poses;
}

/// A fix at each node's time, with horizontal noise of `sigma`, as the receiver states it.
Mission with_fixes(Mission mission, const SE3& T_map_enu, double sigma = 0, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0, 1);
  for (const Node& node : mission.nodes) {
    Vec3 p_enu = T_map_enu.inverse() * node.T_mission_node.t;
    for (int k = 0; k < 2; ++k) p_enu[k] += sigma * noise(random);
    const Geodetic g = from_enu(place, p_enu);
    mission.fixes.push_back({*node.stamp, g.latitude, g.longitude, g.altitude, Mat3::Identity()});
    if (sigma > 0) mission.fixes.back().covariance *= sigma * sigma;
  }
  return mission;
}

GnssAlignment align(const Atlas& atlas, const std::string& yaml = "{}") {
  return component<GnssAligner>("similarity_4dof", yaml)
      ->align(atlas, atlas.islands[0], *make_context());
}

double score(const GnssAlignment& a, const std::string& name) {
  for (const auto& [key, value] : a.scores)
    if (key == name) return value;
  return std::nan("");
}

/// How far two georeferences put a point of the map apart [m].
double apart(const GeoReference& a, const GeoReference& b, const Vec3& p_map) {
  return to_enu(map_to_geodetic(a, p_map), map_to_geodetic(b, p_map)).norm();
}

GeoReference truth(const SE3& T_map_enu) {
  return {place.latitude, place.longitude, place.altitude, T_map_enu, 0, 0};
}

TEST(Similarity4Dof, FindsTheExactTransform) {
  const SE3 T_map_enu = SE3::from_yaw(2.2, {300, -40, 12});
  // The first node stands at the reference point: 300 m away, up differs by 300 / 6.4e6 rad.
  std::vector<SE3> poses = path(60, 1.0);
  for (SE3& pose : poses) pose.t += T_map_enu.t;
  for (const char* yaml : {"{}", "{select: first}", "{nodes: 1000}"}) {
    const Atlas atlas = make_atlas({with_fixes(make_mission("a", poses), T_map_enu)});
    const GnssAlignment found = align(atlas, yaml);
    ASSERT_TRUE(found.georeference) << found.reason;
    EXPECT_LT(apart(*found.georeference, truth(T_map_enu), {340, -30, 14}), 1e-6);
    EXPECT_LT(score(found, "max_horizontal"), 1e-6);
  }
}

TEST(Similarity4Dof, UsesTheMissionsOfAnIslandTogether) {
  const SE3 T_map_enu = SE3::from_yaw(-1.0, {5, 6, 7});
  Atlas atlas = make_atlas({with_fixes(make_mission("a", path(5, 1.0)), T_map_enu),
                            with_fixes(make_mission("b", path(8, 2.0)), T_map_enu)});
  atlas.islands = {{{0, 1}, {}}};
  const GnssAlignment found = align(atlas);
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_EQ(score(found, "nodes"), 13);
}

// 10 nodes 1 m apart: sum of r^2 = 82.5 m^2, so yaw is known to 5 / sqrt(82.5) rad = 31.5 deg.
TEST(Similarity4Dof, RefusesWhenYawIsNotObservable) {
  const Mission mission = with_fixes(make_mission("a", path(10, 1.0, 0)), SE3{}, 5.0);
  const GnssAlignment found = align(make_atlas({mission}));
  EXPECT_FALSE(found.georeference);
  EXPECT_NE(found.reason.find("yaw is known to 3"), std::string::npos) << found.reason;
  EXPECT_TRUE(align(make_atlas({mission}), "{max_sigma_yaw: 90}").georeference);
}

TEST(Similarity4Dof, RefusesWhenAllPlacesCoincide) {
  const Mission standing = with_fixes(make_mission("a", std::vector<SE3>(10)), SE3{});
  EXPECT_FALSE(align(make_atlas({standing}), "{max_sigma_yaw: 179}").georeference);
}

TEST(Similarity4Dof, RefusesFewerThanThreeFixes) {
  Mission mission = with_fixes(make_mission("a", path(10, 5.0)), SE3{});
  mission.fixes.resize(2);
  const GnssAlignment found = align(make_atlas({mission}));
  EXPECT_FALSE(found.georeference);
  EXPECT_EQ(found.reason.rfind("2 nodes", 0), 0u) << found.reason;
  mission.fixes.clear();
  EXPECT_FALSE(align(make_atlas({mission})).georeference);
}

TEST(Similarity4Dof, InterpolatesInTimeButNotAcrossGaps) {
  const SE3 T_map_enu = SE3::from_yaw(0.4, {1, 2, 3});
  Mission mission = with_fixes(make_mission("a", path(40, 1.0, 0)), T_map_enu);
  std::vector<GnssFix> every_fourth;
  for (std::size_t i = 0; i < mission.fixes.size(); i += 4)
    every_fourth.push_back(mission.fixes[i]);
  mission.fixes = every_fourth;
  for (Node& node : mission.nodes) {  // 30 % of a second, and of a metre, later
    node.stamp->nsec = 300'000'000;
    node.T_mission_node.t.x() += 0.3;
  }
  const Atlas atlas = make_atlas({mission});
  const GnssAlignment found = align(atlas, "{max_gap: 4.5}");
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_LT(apart(*found.georeference, truth(T_map_enu), {20, 0, 0}), 1e-3);
  EXPECT_FALSE(align(atlas, "{max_gap: 3.5}").georeference);
}

// Over many noisy receivers the errors are as large as the stated sigmas say.
TEST(Similarity4Dof, StatesHonestSigmas) {
  const SE3 T_map_enu = SE3::from_yaw(0.9, {50, 60, 0});
  const auto poses = path(100, 3.0);
  double yaw_squares = 0, position_squares = 0;
  constexpr int seeds = 300;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Atlas atlas = make_atlas({with_fixes(make_mission("a", poses), T_map_enu, 2.0, seed)});
    const GnssAlignment found = align(atlas, "{nodes: 30}");
    ASSERT_TRUE(found.georeference) << found.reason;
    const GeoReference& g = *found.georeference;
    Vec3 centre = Vec3::Zero();
    for (const SE3& pose : poses) centre += pose.t / double(poses.size());
    const Vec3 error = to_enu(place, map_to_geodetic(g, centre)) - T_map_enu.inverse() * centre;
    const double yaw_error = std::remainder(g.T_map_enu.yaw() - 0.9, 2 * std::numbers::pi);
    yaw_squares += std::pow(yaw_error / g.sigma_yaw, 2);
    position_squares += error.head<2>().squaredNorm() / (2 * g.sigma_position * g.sigma_position);
  }
  // Inflation by the residuals makes them a little cautious: below 1 on average.
  EXPECT_NEAR(std::sqrt(yaw_squares / seeds), 0.95, 0.12);
  EXPECT_NEAR(std::sqrt(position_squares / seeds), 0.95, 0.12);
}

TEST(Similarity4Dof, DoubtsAReceiverThatIsTooSure) {
  Mission mission = with_fixes(make_mission("a", path(100, 3.0)), SE3{}, 2.0);
  const double honest = align(make_atlas({mission})).georeference->sigma_yaw;
  for (GnssFix& fix : mission.fixes) fix.covariance *= 1e-4;
  const GnssAlignment found = align(make_atlas({mission}));
  EXPECT_GT(found.georeference->sigma_yaw, 0.4 * honest);
  EXPECT_GT(score(found, "residual_over_sigma"), 30);
}

TEST(Similarity4Dof, WeighsByCovariance) {
  Mission mission = with_fixes(make_mission("a", path(20, 3.0)), SE3{});
  for (std::size_t i = 0; i < mission.fixes.size(); i += 2) {
    mission.fixes[i].latitude += 1e-4;  // 11 m
    mission.fixes[i].covariance *= 1e6;
  }
  const GnssAlignment found = align(make_atlas({mission}), "{nodes: 20}");
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_LT(apart(*found.georeference, truth(SE3{}), {20, 0, 0}), 0.01);
}

TEST(Similarity4Dof, CountsSharedFixesOnce) {
  Mission mission = with_fixes(make_mission("a", path(101, 1.0)), SE3{}, 1.0);
  std::vector<GnssFix> few;
  for (std::size_t i = 0; i < mission.fixes.size(); i += 20) few.push_back(mission.fixes[i]);
  mission.fixes = few;
  EXPECT_EQ(score(align(make_atlas({mission}), "{nodes: 1000, max_gap: 20}"), "nodes"), 6);
}

TEST(Similarity4Dof, CarriesTheMissionsOwnLines) {
  const SE3 T_map_b = SE3::from_yaw(0.5, {10, 20, 1});
  Mission a = make_mission("a", path(10, 1.0)), b = a;
  b.name = "b";
  const GeoReference in_b = truth(SE3::from_yaw(0.3, {4, 5, 6}));
  b.georeference = in_b;
  Atlas atlas = make_atlas({a, b});
  atlas.islands = {{{0, 1}, {}}};
  auto poses = *atlas.missions[1].T_map_node;
  for (SE3& pose : poses) pose = T_map_b * pose;
  atlas.missions[1].T_map_node = std::make_shared<const std::vector<SE3>>(poses);

  const GnssAlignment one = align(atlas);
  ASSERT_TRUE(one.georeference) << one.reason;
  EXPECT_NEAR(to_enu(map_to_geodetic(in_b, {1, 2, 3}),
                     map_to_geodetic(*one.georeference, T_map_b * Vec3(1, 2, 3)))
                  .norm(),
              0, 1e-6);

  // The other mission says the same, from a reference point 3 km away.
  const Geodetic other{61.22, 25.15, 100};
  const Vec3 o = to_enu(place, other), x = to_enu(place, from_enu(other, {1000, 0, 0})) - o,
             y = to_enu(place, from_enu(other, {0, 1000, 0})) - o;
  Mat4 M = Mat4::Identity();
  M.block<3, 1>(0, 0) = x / 1000;
  M.block<3, 1>(0, 1) = y / 1000;
  M.block<3, 1>(0, 2) = x.cross(y) / 1e6;
  M.block<3, 1>(0, 3) = o;
  GeoReference in_a = *one.georeference;
  in_a.latitude = other.latitude, in_a.longitude = other.longitude, in_a.altitude = other.altitude;
  in_a.T_map_enu = in_a.T_map_enu * SE3::from_matrix(M);
  a.georeference = in_a;
  atlas.missions[0].mission = std::make_shared<const Mission>(a);
  const GnssAlignment both = align(atlas);
  ASSERT_TRUE(both.georeference) << both.reason;
  EXPECT_EQ(score(both, "georeferenced_missions"), 2);
  EXPECT_LT(score(both, "max_position_difference"), 1e-5);
  EXPECT_LT(apart(*both.georeference, *one.georeference, {30, 10, 0}), 1e-5);
}

TEST(Similarity4Dof, AveragesMissionsThatDisagree) {
  Mission a = make_mission("a", path(10, 1.0)), b = a;
  b.name = "b";
  a.georeference = truth(SE3::from_yaw(10 * degree, {0, 0, 0}));
  b.georeference = truth(SE3::from_yaw(-10 * degree, {0, 4, 0}));
  Atlas atlas = make_atlas({a, b});
  atlas.islands = {{{0, 1}, {}}};
  const GnssAlignment found = align(atlas);
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_NEAR(found.georeference->T_map_enu.yaw(), 0, 1e-12);
  EXPECT_NEAR(score(found, "max_yaw_difference"), 10 * degree, 1e-9);
}

// A lap of 6.5 km on a race track, RTK fixes and SLAM poses at 2386 times. The golden values are
// the closed form computed apart (NumPy). The height error is real: the SLAM map is not level.
TEST(Similarity4Dof, AgreesWithAnIndependentSolutionOnARealLap) {
  const auto data = real_data("gnss");
  if (data.empty()) GTEST_SKIP() << "the archive gnss is not there";
  const auto folder = data / "gnss_a2rl_flexcloud";
  std::istringstream fixes(read_file(folder / "positions_interpolated.txt")),
      rows(read_file(folder / "poses_keyframes.txt"));
  const Geodetic abu_dhabi{24.47, 54.6, 0};
  std::vector<SE3> poses;
  std::vector<GnssFix> measured;
  double stamp, unused;
  Vec3 p_enu;
  SE3 T;
  while (fixes >> stamp >> p_enu.x() >> p_enu.y() >> p_enu.z() >> unused >> unused >> unused &&
         rows >> stamp >> T.t.x() >> T.t.y() >> T.t.z() >> T.q.x() >> T.q.y() >> T.q.z() >>
             T.q.w()) {
    const Geodetic g = from_enu(abu_dhabi, p_enu);
    const Stamp when{std::int64_t(poses.size()), 0};  // both files have the same times
    measured.push_back({when, g.latitude, g.longitude, g.altitude, Mat3::Identity()});
    poses.push_back(T);
  }
  ASSERT_EQ(poses.size(), 2386u);
  Mission mission = make_mission("lap", poses);
  mission.fixes = measured;
  const GnssAlignment found = align(make_atlas({mission}), "{nodes: 10000}");
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_EQ(score(found, "nodes"), 2386);
  EXPECT_NEAR(found.georeference->T_map_enu.yaw(), -2.063241, 1e-4);
  EXPECT_NEAR(score(found, "rmse_horizontal"), 3.367419, 1e-2);
  EXPECT_NEAR(score(found, "max_horizontal"), 19.234194, 5e-2);
}

TEST(Similarity4Dof, RefusesBrokenFixes) {
  Mission mission = with_fixes(make_mission("a", path(10, 5.0)), SE3{});
  mission.fixes[3].latitude = std::nan("");
  EXPECT_THROW(align(make_atlas({mission})), Error);
  mission.fixes[3].latitude = 61.2;
  mission.fixes[3].covariance.setZero();
  EXPECT_THROW(align(make_atlas({mission})), Error);
}

}  // namespace
}  // namespace cambium::testing
