// SPDX-License-Identifier: BSD-3-Clause
// The minimum is found, and is that of the one cost.
#pragma once
#include "cambium/dialect.hpp"
#include "common/laws/helix.hpp"

namespace cambium::testing {
namespace {

/// F for every small step of every free pose: none may be lower at an optimum.
void expect_local_minimum(const PoseGraph& g, const std::vector<SE3>& poses) {
  const double F = cost(g, poses);
  for (std::size_t i = 0; i < poses.size(); i += 7)
    for (int k = 0; k < 6; ++k)
      for (const double step : {-1e-4, 1e-4}) {
        if (g.fixed[i]) continue;
        Vec6 xi = Vec6::Zero();
        xi[k] = step;
        auto moved = poses;
        moved[i] = moved[i] * SE3::exp(xi);
        EXPECT_GT(cost(g, moved), F - 1e-9 * F) << "node " << i << " direction " << k;
      }
}

std::string bytes(const Solution& s) {
  std::string out;
  for (const SE3& T : s.T_map_node) out.append(reinterpret_cast<const char*>(&T), sizeof T);
  for (const double w : s.weight) out.append(reinterpret_cast<const char*>(&w), sizeof w);
  return out;
}

using SetAndStart = std::tuple<std::pair<const char*, double>, const char*>;
class ReferenceOptimum : public ::testing::TestWithParam<SetAndStart> {};

// data/pose_graphs/REFERENCE.json, "canon"; from the file's vertices alone torus3D ends elsewhere.
TEST_P(ReferenceOptimum, IsReachedToAMillionth) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  const auto& [set, start] = GetParam();
  const auto& [name, F] = set;
  const auto graph = pose_graph_from(read_g2o(data / name / (std::string(name) + ".g2o")));
  const Solution s = solve(graph, std::string("{initialization: ") + start + "}");
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_NEAR(cost(graph, s.T_map_node) / F, 1, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(PoseGraphs, ReferenceOptimum,
                         ::testing::Combine(::testing::Values(std::pair{"tinyGrid3D", 18.51936642},
                                                              std::pair{"smallGrid3D", 1025.398056},
                                                              std::pair{"parking-garage",
                                                                        1.268384384},
                                                              std::pair{"sphere2500", 1351.215697},
                                                              std::pair{"torus3D", 24227.04556}),
                                            ::testing::Values("chordal", "given")));

TEST(SolverLaws, ChordalStartNeedsNoGivenPoses) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  PoseGraph lost = pose_graph_from(read_g2o(data / "smallGrid3D" / "smallGrid3D.g2o"));
  std::mt19937_64 engine(1);
  for (std::size_t i = 1; i < lost.T_map_node.size(); ++i)
    lost.T_map_node[i] = SE3::exp(noise(engine, 10, 3));
  const Solution chordal = solve(lost), given = solve(lost, "{initialization: local}");
  EXPECT_NEAR(cost(lost, chordal.T_map_node) / 1025.398056, 1, 1e-6);
  EXPECT_LT(2 * chordal.iterations, given.iterations);
}

TEST(SolverLaws, FindsTheMinimumOfTheOneCost) {
  const Helix helix(100);
  const Solution s = solve(helix.graph);
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_LT(helix.largest_error(s.T_map_node), 0.3);
  EXPECT_LT(cost(helix.graph, s.T_map_node), 0.1 * cost(helix.graph, helix.graph.T_map_node));
  EXPECT_EQ(s.weight, std::vector<double>(helix.graph.relative.size(), 1.0));
  expect_local_minimum(helix.graph, s.T_map_node);
}

TEST(SolverLaws, FullInformationAndEveryKindOfFactor) {
  const PoseGraph g = every_kind_of_factor();
  const Solution s = solve(g);
  EXPECT_TRUE(s.converged) << s.message;
  expect_local_minimum(g, s.T_map_node);
}

TEST(SolverLaws, PerfectMeasurementsGiveTheTruth) {
  const Helix helix(60, 3, 0);
  PoseGraph g = helix.graph;
  std::mt19937_64 engine(9);
  for (std::size_t i = 1; i < g.T_map_node.size(); ++i)
    g.T_map_node[i] = g.T_map_node[i] * SE3::exp(noise(engine, 1, 0.3));
  const Solution s = solve(g);
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_LT(helix.largest_error(s.T_map_node), 1e-9);
}

TEST(SolverLaws, DoesNotSeeTheSignOfQuaternions) {
  Helix helix(60);
  const double F = cost(helix.graph, solve(helix.graph).T_map_node);
  for (std::size_t k = 0; k < helix.graph.relative.size(); k += 3)
    helix.graph.relative[k].T_tail_head.q.coeffs() *= -1;
  for (std::size_t i = 0; i < helix.truth.size(); i += 2)
    helix.graph.T_map_node[i].q.coeffs() *= -1;
  EXPECT_NEAR(cost(helix.graph, solve(helix.graph).T_map_node) / F, 1, 1e-9);
}

TEST(SolverLaws, MovesWithItsFixedNode) {
  const Helix helix(60);
  PoseGraph moved = helix.graph;
  const SE3 T_new_old = SE3::from_yaw(2.0, Vec3(300, -200, 10));
  for (SE3& T : moved.T_map_node) T = T_new_old * T;
  const auto a = solve(helix.graph).T_map_node, b = solve(moved).T_map_node;
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((T_new_old * a[i].t - b[i].t).norm(), 1e-5);
  EXPECT_EQ(b[0].t, moved.T_map_node[0].t);  // held to the last bit
  EXPECT_EQ(b[0].q.coeffs(), moved.T_map_node[0].q.coeffs());
}

TEST(SolverLaws, SameBytesForAnyThreadCount) {
  const Helix helix(200);
  const std::string yaml = "{loss: dcs}", once = bytes(solve(helix.graph, yaml, 1));
  EXPECT_EQ(once, bytes(solve(helix.graph, yaml, 1)));
  EXPECT_EQ(once, bytes(solve(helix.graph, yaml, 2)));
  EXPECT_EQ(once, bytes(solve(helix.graph, yaml, 7)));
}

}  // namespace
}  // namespace cambium::testing
