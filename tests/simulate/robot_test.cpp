// SPDX-License-Identifier: BSD-3-Clause
// Paths, odometry, GNSS: what the robot did and what it believes.
#include <gtest/gtest.h>

#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/gnss.hpp"
#include "simulate/odometry.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

Terrain level_ground() {
  TerrainSpec t;
  t.max_slope = t.roughness = 0;
  return make_terrain(t, {200, 200}, 1);
}

MissionSpec along_a_line(double length, double spacing) {
  MissionSpec m;
  m.path.kind = "line";
  m.path.size = {length, 0};
  m.path.spacing = spacing;
  m.sensor.sway = 0;
  return m;
}

TEST(Path, NodesAreEquallySpacedAndFaceForward) {
  MissionSpec m = along_a_line(100, 2);
  m.path.heading = 30, m.path.offset = 5, m.path.center = {1, 2};
  const auto poses = walk(m, level_ground(), {}, 1);
  ASSERT_EQ(poses.size(), 51u);
  const double a = radians(30);
  const Vec3 forward(std::cos(a), std::sin(a), 0), left(-std::sin(a), std::cos(a), 0);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vec3 expected = Vec3(1, 2, 1.6) + (2.0 * double(i) - 50) * forward + 5 * left;
    EXPECT_LT((poses[i].T_world_base.t - expected).norm(), 1e-9);
    EXPECT_NEAR(poses[i].T_world_base.yaw(), a, 1e-9);
    EXPECT_TRUE(i == 0 || poses[i].time > poses[i - 1].time);
  }
}

TEST(Path, ReversedVisitsTheSamePlacesBackwards) {
  for (const char* kind : {"loop", "lawn_mower", "line"}) {
    PathSpec p;
    p.kind = kind, p.size = {40, 20}, p.heading = 10, p.offset = 3;
    auto there = path_corners(p);
    p.reversed = true;
    const auto back = path_corners(p);
    std::reverse(there.begin(), there.end());
    EXPECT_EQ(there, back) << kind;
  }
}

TEST(Path, LoopClosesAndALargerOffsetShrinksIt) {
  PathSpec p;
  p.size = {40, 30};
  const auto ellipse = path_corners(p);
  EXPECT_LT((ellipse.front() - ellipse.back()).norm(), 1e-9);
  EXPECT_NEAR(ellipse[45].x(), 20, 1e-9);  // counter-clockwise: its left is inside
  p.offset = 5;
  EXPECT_NEAR(path_corners(p)[45].x(), 15, 1e-3);
}

TEST(Path, TheRobotKeepsClearOfStemsAtItsHeight) {
  Stem in_the_way;
  in_the_way.base = {0, 0.01, 0}, in_the_way.dbh = 0.3, in_the_way.height = 20;
  Stem low = in_the_way;
  low.base.x() = 20, low.height = 1;  // the sensor passes over it
  const auto poses = walk(along_a_line(60, 1), level_ground(), {in_the_way, low}, 1);
  double nearest = 1e9, off_the_line = 0;
  for (const TruePose& p : poses) {
    const Vec3& t = p.T_world_base.t;
    nearest = std::min(nearest, std::hypot(t.x(), t.y() - 0.01));
    if (t.x() > 10) off_the_line = std::max(off_the_line, std::abs(t.y()));
  }
  EXPECT_GE(nearest, in_the_way.radius_at(1.6) + 0.5 - 1e-9);
  EXPECT_EQ(off_the_line, 0);
}

TEST(Odometry, FirstNodeIsTheOriginAndGravityIsVertical) {
  MissionSpec m = along_a_line(100, 2);
  m.path.heading = 77, m.sensor.sway = 3;
  const auto truth = walk(m, level_ground(), {}, 4);
  const auto believed = believed_poses(truth, m.odometry, 0, 4);
  EXPECT_EQ(believed[0].t.norm(), 0);
  EXPECT_NEAR(believed[0].yaw(), 0, radians(1.5));  // tilt moves it a little
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vec3 up = believed[i].q * (truth[i].T_world_base.q.conjugate() * Vec3::UnitZ());
    squares += up.head<2>().squaredNorm();
  }
  // Two axes of 0.3 degrees each, 51 nodes: 10 % is one standard error.
  EXPECT_NEAR(std::sqrt(squares / double(truth.size()) / 2), radians(0.3), radians(0.1));
}

TEST(Odometry, WithoutErrorsItIsTheTruthInAnotherFrame) {
  MissionSpec m = along_a_line(100, 2);
  m.odometry.drift = m.odometry.tilt = 0;
  m.sensor.sway = 4, m.path.heading = -40;
  const auto truth = walk(m, level_ground(), {}, 4);
  const auto believed = believed_poses(truth, m.odometry, 0, 4);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const SE3 was = truth[0].T_world_base.inverse() * truth[i].T_world_base;
    const SE3 is = believed[0].inverse() * believed[i];
    EXPECT_LT((was.inverse() * is).log().norm(), 1e-9);
  }
}

struct EndError {
  double horizontal = 0, vertical = 0;  ///< root mean square over many robots [m]
};
EndError end_error(const MissionSpec& m) {
  const auto truth = walk(m, level_ground(), {}, 1);
  EndError rms;
  constexpr int robots = 2000;
  for (int seed = 0; seed < robots; ++seed) {
    const Vec3 end = believed_poses(truth, m.odometry, 0, std::uint64_t(seed)).back().t;
    const Vec3 was = truth.back().T_world_base.t - truth.front().T_world_base.t;
    rms.horizontal += (end - was).head<2>().squaredNorm() / robots;
    rms.vertical += end.z() * end.z() / robots;
  }
  return {std::sqrt(rms.horizontal), std::sqrt(rms.vertical)};
}

TEST(Odometry, DriftIsTheShareOfThePathThatWasAskedFor) {
  for (const double percent : {0.05, 0.5, 2.0}) {
    MissionSpec m = along_a_line(100, 1);
    m.odometry.drift = percent, m.odometry.tilt = 0;
    EXPECT_NEAR(end_error(m).horizontal, percent, 0.06 * percent);  // of 100 m
  }
}

TEST(Odometry, DriftGrowsWithThePower15OfThePath) {
  MissionSpec m = along_a_line(50, 1);
  m.odometry.drift = 1, m.odometry.tilt = 0;
  EXPECT_NEAR(end_error(m).horizontal, std::pow(0.5, 1.5), 0.06 * std::pow(0.5, 1.5));
}

TEST(Odometry, HeightErrorComesFromTheTilt) {
  MissionSpec m = along_a_line(100, 1);
  m.odometry.drift = 0, m.odometry.tilt = 0.3;
  // 100 independent steps of 1 m.
  EXPECT_NEAR(end_error(m).vertical, std::sqrt(100.0) * radians(0.3), 0.1 * radians(3));
}

std::vector<TruePose> hour_on_one_spot() {
  std::vector<TruePose> out;
  for (int i = 0; i <= 2; ++i) out.push_back({SE3{Quat::Identity(), Vec3(10, 20, 5)}, 1800.0 * i});
  return out;
}

std::vector<Vec3> errors_of(const GnssSpec& spec, std::uint64_t seed) {
  const Geodetic reference{61.2, 25.1, 150};
  std::vector<Vec3> out;
  for (const GnssFix& f : observe(hour_on_one_spot(), spec, 1700000000, reference, seed))
    out.push_back(to_enu(reference, {f.latitude, f.longitude, f.altitude}) - Vec3(10, 20, 5));
  return out;
}

TEST(Gnss, NoiseHasItsSizeAndItsMemory) {
  GnssSpec spec;
  spec.enabled = true, spec.sigma = 3, spec.correlation_time = 20;
  double squares = 0, up = 0, product = 0;
  std::size_t n = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto e = errors_of(spec, seed);
    ASSERT_EQ(e.size(), 3601u);
    for (std::size_t i = 20; i < e.size(); ++i, ++n) {
      squares += e[i].x() * e[i].x(), up += e[i].z() * e[i].z();
      product += e[i].x() * e[i - 20].x();  // 20 s apart
    }
  }
  EXPECT_NEAR(std::sqrt(squares / double(n)), 3, 0.2);
  EXPECT_NEAR(std::sqrt(up / double(n)), 3 * 1.8, 0.4);
  EXPECT_NEAR(product / squares, std::exp(-1), 0.08);
}

TEST(Gnss, OutagesTakeTheirShare) {
  GnssSpec spec;
  spec.enabled = true, spec.outage_interval = 90, spec.outage_duration = 30;
  double fixes = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) fixes += double(errors_of(spec, seed).size());
  EXPECT_NEAR(fixes / 40 / 3601, 0.75, 0.03);  // 90 s with, 30 s without
}

TEST(Gnss, HeightJumpsAndOnlyTheHeight) {
  GnssSpec spec;
  spec.enabled = true, spec.sigma = 0.01, spec.jump_interval = 60, spec.jump_height = 15;
  double horizontal = 0, share = 0;
  for (const Vec3& e : errors_of(spec, 3)) {
    horizontal = std::max(horizontal, e.head<2>().norm());
    share += std::abs(e.z()) > 0.2;
  }
  EXPECT_LT(horizontal, 0.06);
  EXPECT_NEAR(share / 3601, 0.25, 0.12);  // 60 s without, 20 s with
}

}  // namespace
}  // namespace cambium::simulate
