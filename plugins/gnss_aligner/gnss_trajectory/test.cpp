// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <sstream>

#include "cambium/files.hpp"
#include "common/receiver.hpp"

namespace cambium::testing {
namespace {

using gnss::degree;

const SE3 T_map_enu = SE3::from_yaw(0.9, {50, 60, 7});

GnssAlignment found(const Mission& mission, const std::string& yaml = "{}") {
  return align("gnss_trajectory", make_atlas({mission}), yaml);
}

/// Root mean square of yaw errors [rad], and of yaw and position errors over their stated sigmas.
struct Honesty {
  double yaw = 0, yaw_normalised = 0, position_normalised = 0;
};

Honesty honesty(const std::vector<SE3>& poses, const Receiver& receiver, int seeds = 100) {
  Honesty h;
  Vec3 centre = Vec3::Zero();
  for (const SE3& pose : poses) centre += pose.t / double(poses.size());
  const Mission mission = walked("a", poses, 4);
  for (unsigned seed = 0; seed < unsigned(seeds); ++seed) {
    const GnssAlignment a = found(with_receiver(mission, T_map_enu, receiver, seed));
    EXPECT_TRUE(a.georeference) << a.reason;
    if (!a.georeference) return h;
    const GeoReference& g = *a.georeference;
    h.yaw += std::pow(yaw_error(a, T_map_enu), 2) / seeds;
    h.yaw_normalised += std::pow(yaw_error(a, T_map_enu) / g.sigma_yaw, 2) / seeds;
    h.position_normalised += misplaced(a, T_map_enu, centre).head<2>().squaredNorm() /
                             (2 * g.sigma_position * g.sigma_position) / seeds;
  }
  h = {std::sqrt(h.yaw), std::sqrt(h.yaw_normalised), std::sqrt(h.position_normalised)};
  // --gtest_output=json: the table of docs/gnss.md
  const std::string name = (poses.back().t.norm() > 500 ? "line_" : "circle_") +
                           std::to_string(int(receiver.correlation_time)) + "s";
  ::testing::Test::RecordProperty(name, std::to_string(h.yaw / degree) + " deg, normalised " +
                                            std::to_string(h.yaw_normalised) + " and " +
                                            std::to_string(h.position_normalised));
  return h;
}

TEST(GnssTrajectory, FindsTheExactTransform) {
  const GnssAlignment a = found(with_receiver(walked("a", winding(40, 4), 4), T_map_enu, {}));
  ASSERT_TRUE(a.georeference) << a.reason;
  EXPECT_LT(misplaced(a, T_map_enu, {100, 50, 3}).norm(), 1e-3);  // up differs by 150 m / 6.4e6 m
  EXPECT_EQ(score(a, "outliers"), 0);
  EXPECT_EQ(score(a, "fixes"), 157);
}

// The target of the project: 1 km, 5 m, correlated over 10 s: better than 0.3 deg, and honest.
TEST(GnssTrajectory, KnowsYawOnAKilometreAndHowWell) {
  const Honesty h = honesty(winding(251, 4), {.sigma = 5, .correlation_time = 10});
  EXPECT_LT(h.yaw, 0.2 * degree);
  EXPECT_NEAR(h.yaw_normalised, 1, 0.2);  // 100 seeds: the figure itself is known to 7 %
  EXPECT_NEAR(h.position_normalised, 1, 0.2);
}

TEST(GnssTrajectory, StatesHonestSigmasForOtherReceiversAndPaths) {
  for (const double correlation_time : {0.0, 10.0, 30.0, 60.0})
    for (const auto& poses : {winding(251, 4), circle(251, 4)}) {
      const Honesty h = honesty(poses, {.sigma = 5, .correlation_time = correlation_time}, 40);
      // Of a noise with memory of a minute, 1000 s say little: sigmas are cautious then.
      EXPECT_GT(h.yaw_normalised, 0.7) << correlation_time;
      EXPECT_LT(h.yaw_normalised, 1.25) << correlation_time;
      EXPECT_GT(h.position_normalised, 0.6) << correlation_time;
      EXPECT_LT(h.position_normalised, 1.25) << correlation_time;
    }
}

TEST(GnssTrajectory, CountsIndependentFixes) {
  const Mission mission = walked("a", winding(251, 4), 4);
  const auto effective = [&](double correlation_time) {
    std::vector<double> counts;
    for (unsigned seed = 0; seed < 9; ++seed)
      counts.push_back(
          score(found(with_receiver(mission, T_map_enu,
                                    {.sigma = 5, .correlation_time = correlation_time}, seed)),
                "effective_fixes"));
    return median(counts);
  };
  EXPECT_NEAR(effective(0), 1000, 250);
  EXPECT_NEAR(effective(10), 1000 / 20.0, 25);  // the duration over twice the correlation time
}

/// Over ten seeds: root mean square of yaw errors [rad] and of position errors [m], and the largest
/// yaw error over its stated sigma.
struct Survival {
  double yaw = 0, position = 0, normalised = 0;
};

Survival survival(Receiver receiver, const std::string& yaml = "{}") {
  receiver.sigma = 3, receiver.correlation_time = 10;
  Survival out;
  const Mission mission = walked("a", winding(251, 4), 4);
  for (unsigned seed = 0; seed < 10; ++seed) {
    const GnssAlignment a = found(with_receiver(mission, T_map_enu, receiver, seed), yaml);
    EXPECT_TRUE(a.georeference) << a.reason;
    if (!a.georeference) return out;
    const double yaw = yaw_error(a, T_map_enu);
    out.yaw += yaw * yaw / 10;
    out.position += misplaced(a, T_map_enu, {500, 0, 0}).head<2>().squaredNorm() / 10;
    out.normalised = std::max(out.normalised, std::abs(yaw) / a.georeference->sigma_yaw);
  }
  out = {std::sqrt(out.yaw), std::sqrt(out.position), out.normalised};
  ::testing::Test::RecordProperty("with" + yaml, std::to_string(out.yaw / degree) + " deg, " +
                                                     std::to_string(out.position) + " m");
  return out;
}

TEST(GnssTrajectory, SurvivesOutagesOf40Percent) {
  const Survival s = survival({.outage = 0.4});
  EXPECT_LT(s.yaw, 0.2 * degree);
  EXPECT_LT(s.position, 1.5);
  EXPECT_LT(s.normalised, 3.5);
}

TEST(GnssTrajectory, SurvivesJumpsOf20Metres) {
  const Survival s = survival({.jump = 0.25});
  EXPECT_LT(s.yaw, 0.2 * degree);
  EXPECT_LT(s.position, 1.5);
  EXPECT_LT(s.normalised, 3.5);
  EXPECT_GT(survival({.jump = 0.25}, "{outlier_width: 30}").position, 3 * s.position);
}

// The last 40 % of the fixes drift off, up to 40 m: where the drift begins it looks like noise, so
// something of it stays.
TEST(GnssTrajectory, SurvivesABentFixTrack) {
  const Survival s = survival({.bend = 0.4}), all = survival({.bend = 0.4}, "{outlier_width: 30}");
  EXPECT_LT(s.yaw, 0.8 * degree);
  EXPECT_LT(s.yaw, 0.5 * all.yaw);
  EXPECT_LT(s.normalised, 4);
}

TEST(GnssTrajectory, SurvivesAllOfItTogether) {
  const Survival s = survival({.outage = 0.4, .jump = 0.12, .bend = 0.15});
  EXPECT_LT(s.yaw, 0.5 * degree);
  EXPECT_LT(s.position, 3);
  EXPECT_LT(s.normalised, 4);
}

// 10 nodes 1 m apart: sum of r^2 = 82.5 m^2, so 5 m of noise leave 5 / sqrt(82.5) rad = 32 deg.
TEST(GnssTrajectory, RefusesWithTheFigureWhenYawIsNotObservable) {
  Mission mission = make_mission("a", winding(10, 1, 0));
  mission = with_receiver(mission, T_map_enu, {.sigma = 5});
  const GnssAlignment a = found(mission);
  EXPECT_FALSE(a.georeference);
  EXPECT_GE(score(a, "sigma_yaw"), 31 * degree);
  EXPECT_NE(a.reason.find("yaw is known to"), std::string::npos) << a.reason;
  EXPECT_TRUE(found(mission, "{max_sigma_yaw: 180}").georeference);
  const auto standing = walked("a", std::vector<SE3>(20), 4);
  EXPECT_FALSE(found(with_receiver(standing, T_map_enu, {}), "{max_sigma_yaw: 180}").georeference);
}

TEST(GnssTrajectory, RefusesFewerThanThreeFixesOnThePath) {
  Mission mission = with_receiver(walked("a", winding(20, 4), 4), T_map_enu, {.time_offset = 0.5});
  EXPECT_FALSE(found(mission, "{max_gap: 3.9}").georeference);
  mission.fixes.erase(mission.fixes.begin(), mission.fixes.end() - 2);
  const GnssAlignment a = found(mission);
  EXPECT_EQ(a.reason.rfind("2 of 2 GNSS fixes", 0), 0u) << a.reason;
  for (Node& node : mission.nodes) node.stamp.reset();
  EXPECT_FALSE(found(mission).georeference);
}

TEST(GnssTrajectory, KnowsWhereTheAntennaIsAndHowItsClockGoes) {
  const Mission mission = with_receiver(walked("a", winding(60, 4), 4), T_map_enu,
                                        {.lever_arm = Vec3(-0.5, 0.25, 1.5), .time_offset = 0.75});
  const GnssAlignment a = found(mission, "{lever_arm: [-0.5, 0.25, 1.5], time_offset: 0.75}");
  ASSERT_TRUE(a.georeference) << a.reason;
  EXPECT_LT(misplaced(a, T_map_enu, {100, 0, 0}).norm(), 1e-2);
  EXPECT_GT(misplaced(found(mission), T_map_enu, {100, 0, 0}).norm(), 1);
  EXPECT_THROW(component<GnssAligner>("gnss_trajectory", "{lever_arm: [1, 2]}"), Error);
}

TEST(GnssTrajectory, HeightIsAMedianAndDoesNotTurnTheMap) {
  Mission mission = with_receiver(walked("a", winding(100, 4), 4), T_map_enu, {.sigma = 1});
  const GnssAlignment clean = found(mission);
  for (std::size_t i = 0; i < mission.fixes.size(); ++i)
    if (i % 5 < 2) mission.fixes[i].altitude += 80;
  const GnssAlignment a = found(mission);
  ASSERT_TRUE(a.georeference) << a.reason;
  EXPECT_NEAR(a.georeference->T_map_enu.yaw(), clean.georeference->T_map_enu.yaw(), 1e-6);
  EXPECT_LT(std::abs(misplaced(a, T_map_enu, {200, 0, 0}).z()), 3);
}

TEST(GnssTrajectory, OneReceiverPlacesTheWholeIsland) {
  const Mission without = walked("a", winding(20, 4), 4),
                with = with_receiver(walked("b", winding(60, 4), 4), T_map_enu, {});
  Atlas atlas = make_atlas({without, with});
  atlas.islands = {{{0, 1}, {}}};
  const GnssAlignment a = align("gnss_trajectory", atlas);
  ASSERT_TRUE(a.georeference) << a.reason;
  EXPECT_LT(misplaced(a, T_map_enu, {10, 0, 0}).norm(), 1e-2);
}

TEST(GnssTrajectory, TheOrderOfFixesDoesNotShow) {
  Mission mission = with_receiver(walked("a", winding(60, 4), 4), T_map_enu,
                                  {.sigma = 2, .correlation_time = 5, .jump = 0.2});
  const GnssAlignment a = found(mission);
  std::reverse(mission.fixes.begin(), mission.fixes.end());
  const GnssAlignment b = found(mission);
  EXPECT_EQ(a.georeference->T_map_enu.t, b.georeference->T_map_enu.t);
  EXPECT_EQ(a.georeference->sigma_yaw, b.georeference->sigma_yaw);
}

TEST(GnssTrajectory, FallsBackOnTheMissionsOwnLines) {
  Mission mission = walked("a", winding(10, 1), 4);
  mission.georeference =
      GeoReference{place.latitude, place.longitude, place.altitude, T_map_enu, 0, 0};
  const GnssAlignment a = found(mission);
  ASSERT_TRUE(a.georeference);
  EXPECT_LT(misplaced(a, T_map_enu, {5, 5, 5}).norm(), 1e-6);
  EXPECT_NE(a.reason.find("own GNSS lines"), std::string::npos) << a.reason;
}

}  // namespace
}  // namespace cambium::testing
