// SPDX-License-Identifier: BSD-3-Clause
// What holds a graph where it is.
#pragma once
#include "common/laws/helix.hpp"

namespace cambium::testing {
namespace {

TEST(SolverLaws, EveryComponentStaysWhereItsFirstNodeIs) {
  Helix helix(60);
  PoseGraph g = helix.graph;
  const SE3 T_far = SE3::from_yaw(1.0, Vec3(1000, 0, 0));
  for (std::size_t i = 0; i < 60; ++i) {
    g.T_map_node.push_back(T_far * helix.graph.T_map_node[i]);
    g.ids.push_back(NodeId(100 + i));
    g.fixed.push_back(false);
  }
  for (const auto& f : helix.graph.relative) {
    g.relative.push_back(f);
    g.relative.back().tail += 60, g.relative.back().head += 60;
  }
  g.T_map_node.push_back(SE3::from_yaw(0.1));  // and a node without any factor
  g.ids.push_back(999), g.fixed.push_back(false);
  const auto poses = solve(g).T_map_node;
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_LT((poses[60 + i].t - T_far * poses[i].t).norm(), 1e-5);
  EXPECT_EQ(poses[60].t, g.T_map_node[60].t);
  EXPECT_EQ(poses[120].q.coeffs(), g.T_map_node[120].q.coeffs());
}

TEST(SolverLaws, PositionsMoveAGraphThatNothingHolds) {
  Helix helix(60);
  const SE3 T_enu_map = SE3::from_yaw(2.5, Vec3(100, 50, 3));
  helix.graph.fixed[0] = false;
  for (std::size_t i = 0; i < 60; i += 4)
    helix.graph.positions.push_back(
        {i, T_enu_map * helix.truth[i].t, Mat3::Identity() * 100, true, ""});
  const auto poses = solve(helix.graph, "{loss: cauchy}").T_map_node;
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_LT((poses[i].t - T_enu_map * helix.truth[i].t).norm(), 0.3);
}

TEST(SolverLaws, AttitudeLevelsAGraphWithoutMovingItsYaw) {
  Helix helix(60);
  helix.graph.fixed[0] = false;
  const SE3 T_tilt = SE3{Quat(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX())), Vec3::Zero()};
  for (std::size_t i = 0; i < 60; ++i) {
    helix.graph.T_map_node[i] = T_tilt * helix.graph.T_map_node[i];
    helix.graph.attitude.push_back({i, helix.truth[i].q.conjugate() * Vec3::UnitZ(), 0.01});
  }
  const auto poses = solve(helix.graph).T_map_node;
  for (std::size_t i = 0; i < 60; ++i)
    EXPECT_LT((poses[i].q * (helix.truth[i].q.conjugate() * Vec3::UnitZ()) - Vec3::UnitZ()).norm(),
              0.02);
  EXPECT_NEAR(poses[0].yaw(), helix.graph.T_map_node[0].yaw(), 0.05);
}

}  // namespace
}  // namespace cambium::testing
