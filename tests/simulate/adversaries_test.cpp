// SPDX-License-Identifier: BSD-3-Clause
// Every adversary is what its name says.
#include <cmath>
#include <set>

#include "simulate/angles.hpp"
#include "simulate/folders.hpp"

namespace cambium::simulate {
namespace {

TEST(Adversary, PlantationRepeatsItself) {
  const Simulated s("plantation_lattice");
  std::set<std::pair<long, long>> places;  // [mm]
  const auto mm = [](double v) { return std::lround(1000 * v); };
  const auto map = s.table("stems.csv");
  for (const auto& row : map)
    places.insert({mm(std::stod(row.at("x"))), mm(std::stod(row.at("y")))});
  std::size_t inner = 0, repeated = 0;
  for (const auto& [x, y] : places) {
    if (std::max(std::abs(x), std::abs(y)) > 38000) continue;
    ++inner;
    repeated += places.contains({x + 4000, y}) && places.contains({x, y + 4000});
  }
  EXPECT_GT(inner, 300u);
  EXPECT_EQ(repeated, inner);
}

TEST(Adversary, ClearingShowsNothingButGround) {
  const Simulated s("empty_clearing");
  for (const char* name : {"mission_a", "mission_b"}) {
    const Mission mission = s.mission(name);
    const auto truth = s.truth(name);
    std::size_t points = 0;
    for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
      const Payload p = mission.nodes[i].payload->load();
      for (Eigen::Index k = 0; k < p.cloud->points().cols(); ++k, ++points) {
        const Vec3 w = truth[i].T_map_node * Vec3(p.cloud->points().col(k).cast<double>());
        ASSERT_NEAR(w.z(), 0, 0.15);  // range noise and bumps
      }
      for (const Tree& tree : *p.trees) EXPECT_FALSE(tree.reconstructed);
    }
    EXPECT_GT(points, 1000u);
  }
}

TEST(Adversary, ThirtyPercentAreHarvestedBetweenTheMissions) {
  const Simulated s("harvested");
  double before = 0, after = 0;
  for (const auto& row : s.table("stems.csv"))
    before += row.at("mission_a") == "1", after += row.at("mission_b") == "1";
  EXPECT_EQ(before, double(s.summary.stems));
  EXPECT_NEAR(after / before, 0.7, 0.05);
}

TEST(Adversary, MissionsThatNeverMeetShareNoLoop) {
  const Simulated s("never_meet");
  EXPECT_EQ(s.summary.loops_between, 0u);
  double nearest = 1e9;
  for (const auto& a : s.truth("mission_a"))
    for (const auto& b : s.truth("mission_b"))
      nearest = std::min(nearest, (a.T_map_node.t - b.T_map_node.t).norm());
  EXPECT_GT(nearest, 2 * 30);  // neither sees a point that the other sees
}

double gravity_error(const Simulated& s, const std::string& mission) {
  const Mission m = s.mission(mission);
  const auto truth = s.truth(mission);
  Vec3 up = Vec3::Zero();  // the world's, in the mission's frame
  for (std::size_t i = 0; i < m.nodes.size(); ++i)
    up += m.nodes[i].T_mission_node.q * (truth[i].T_map_node.q.conjugate() * Vec3::UnitZ());
  return std::acos(up.normalized().z());
}

TEST(Adversary, GravityIsWrongInOneMission) {
  const Simulated s("wrong_gravity");
  EXPECT_LT(gravity_error(s, "mission_a"), radians(0.5));
  EXPECT_NEAR(gravity_error(s, "mission_b"), radians(12), radians(0.5));
}

TEST(Adversary, StampsAreDuplicated) {
  const Simulated s("duplicate_stamps");
  const auto repeats = [&](const std::string& name) {
    const Mission m = s.mission(name);
    std::size_t count = 0;
    for (std::size_t i = 1; i < m.nodes.size(); ++i) {
      count += m.nodes[i].stamp == m.nodes[i - 1].stamp;
      EXPECT_GE(*m.nodes[i].stamp, *m.nodes[i - 1].stamp);
    }
    return count;
  };
  EXPECT_EQ(repeats("mission_a"), 3u);
  EXPECT_EQ(repeats("mission_b"), 0u);
}

TEST(Adversary, CarriedRobotBelievesThatItStoodStill) {
  const Simulated s("carried");
  const Mission m = s.mission("mission_b");
  const auto truth = s.truth("mission_b");
  for (std::size_t i = 1; i < m.nodes.size(); ++i) {
    const Vec3 believed = m.edges[i - 1].T_tail_head.t;
    const Vec3 was = (truth[i - 1].T_map_node.inverse() * truth[i].T_map_node).t;
    if (i == 5) {
      EXPECT_LT(believed.norm(), 1e-9);
      EXPECT_GT(was.norm(), 10);
    } else {
      EXPECT_LT((believed - was).norm(), 0.15);
    }
  }
}

}  // namespace
}  // namespace cambium::simulate
