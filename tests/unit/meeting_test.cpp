// SPDX-License-Identifier: BSD-3-Clause
#include "engine/meeting.hpp"

#include "cambium/geodesy.hpp"
#include "support/maps.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

const Geodetic origin{61.2, 25.1, 150};

std::vector<SE3> walk(double length, double step = 5) {
  std::vector<SE3> poses;
  for (double x = 0; x <= length; x += step) poses.push_back(SE3::from_yaw(0, {x, 0, 0}));
  return poses;
}

GnssFix fix_at(const Vec3& p_enu, double seconds, double sigma) {
  const Geodetic g = from_enu(origin, p_enu);
  GnssFix fix;
  fix.stamp = {std::int64_t(seconds), 0};
  fix.latitude = g.latitude, fix.longitude = g.longitude, fix.altitude = g.altitude;
  fix.covariance = sigma * sigma * Mat3::Identity();
  return fix;
}

/// Walks 100 m east from `start`, a node every second, with a fix at each of the first `fixes`.
Mission walker(const std::string& name, const Vec3& start, std::size_t fixes = 21,
               double sigma = 2) {
  Mission mission = make_mission(name, walk(100));
  for (std::size_t i = 0; i < fixes; ++i)
    mission.fixes.push_back(fix_at(start + Vec3(5.0 * double(i), 0, 0), double(i), sigma));
  return mission;
}

using Apart = Meetings::Apart;

Apart apart(const Mission& a, const Mission& b, double max_distance = 100) {
  return Meetings(make_atlas({a, b}), max_distance).apart(1, 0);
}

}  // namespace

TEST(Meetings, MissionsThatGnssPutsFarApartNeverMet) {
  const Mission a = walker("a", {0, 0, 0});
  // Paths of 100 m end to end: 112 m less three sigmas of both are left between them.
  EXPECT_EQ(apart(a, walker("b", {230, 0, 0})), Apart::by_gnss);
  EXPECT_EQ(apart(a, walker("b", {205, 0, 0})), Apart::no);
  EXPECT_EQ(apart(a, walker("b", {0, 130, 0})), Apart::by_gnss);
  EXPECT_EQ(apart(a, walker("b", {0, 130, 0}), 200), Apart::no);
  EXPECT_EQ(apart(a, walker("b", {5000, 0, 0}), 0), Apart::no);  // 0: all are compared
}

TEST(Meetings, WhatIsNotKnownMayHaveMet) {
  const Mission a = walker("a", {0, 0, 0});
  EXPECT_EQ(apart(a, walker("b", {9000, 0, 0}, 0)), Apart::no);
  EXPECT_EQ(apart(a, walker("b", {9000, 0, 0}, 4)), Apart::no);  // too few to believe
  Mission late = walker("b", {9000, 0, 0});
  for (GnssFix& fix : late.fixes) fix.stamp.sec += 10000;  // of another day
  EXPECT_EQ(apart(a, late), Apart::no);
}

TEST(Meetings, ARobotMayWalkOutOfSightOfItsFixes) {
  const Mission a = walker("a", {0, 0, 0});
  // Fixes on the first 20 m only: the rest of the path may lead anywhere, also back towards a.
  EXPECT_EQ(apart(a, walker("b", {255, 0, 0}, 5)), Apart::no);
  EXPECT_EQ(apart(a, walker("b", {400, 0, 0}, 5)), Apart::by_gnss);
}

TEST(Meetings, PoorFixesCountLess) {
  EXPECT_EQ(apart(walker("a", {0, 0, 0}), walker("b", {230, 0, 0}, 21, 10)), Apart::no);
}

TEST(Meetings, AGeoreferenceServesWhicheverWayItsFrameIsTurned) {
  const auto at = [](const std::string& name, const Vec3& start) {
    Mission mission = make_mission(name, walk(100));
    GeoReference g{origin.latitude, origin.longitude, origin.altitude, {}};
    g.T_map_enu.t = -start;
    mission.georeference = g;
    return mission;
  };
  EXPECT_EQ(apart(at("a", {0, 0, 0}), at("b", {0, 350, 0})), Apart::by_gnss);
  // Turned about its first node, b would come within reach of a.
  EXPECT_EQ(apart(at("a", {0, 0, 0}), at("b", {0, 180, 0})), Apart::no);
}

TEST(Meetings, WithinAnIslandTheMapDecides) {
  const Mission a = walker("a", {0, 0, 0}), b = walker("b", {0, 0, 0});
  const Atlas atlas = tied(make_atlas({a, b}));
  EXPECT_EQ(Meetings(atlas, 100).apart(1, 0), Apart::no);
  // 5 % of both paths may be drift.
  EXPECT_EQ(Meetings(moved(atlas, 1, SE3::from_yaw(0, {0, 108, 0})), 100).apart(1, 0), Apart::no);
  EXPECT_EQ(Meetings(moved(atlas, 1, SE3::from_yaw(0, {0, 115, 0})), 100).apart(1, 0),
            Apart::by_map);
}
