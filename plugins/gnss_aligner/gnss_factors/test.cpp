// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>

#include "common/receiver.hpp"

namespace cambium::testing {
namespace {

const SE3 T_map_enu = SE3::from_yaw(0.9, {50, 60, 7});

GnssAlignment factors(const Atlas& atlas, const std::string& yaml = "{}") {
  return align("gnss_factors", atlas, yaml);
}

/// The path as a robot sees it whose heading drifts by `drift` [rad] a node.
std::vector<SE3> bent(const std::vector<SE3>& poses, double drift) {
  std::vector<SE3> out{poses.front()};
  for (std::size_t i = 1; i < poses.size(); ++i)
    out.push_back(out.back() * poses[i - 1].inverse() * poses[i] * SE3::from_yaw(drift));
  return out;
}

/// Odometry of the mission and the position factors of the alignment, solved.
std::vector<SE3> relaxed(const Atlas& atlas, const GnssAlignment& found) {
  const Mission& mission = *atlas.missions[0].mission;
  Mat6 odometry = 2500 * Mat6::Identity();                      // 0.02 m
  odometry.bottomRightCorner<3, 3>() = 1e5 * Mat3::Identity();  // 0.003 rad
  PoseGraph graph;
  graph.T_map_node = *atlas.missions[0].T_map_node;
  for (const Node& node : mission.nodes) graph.ids.push_back(node.id);
  graph.fixed.assign(mission.nodes.size(), false);
  for (const Edge& e : mission.edges)
    graph.relative.push_back(
        {std::size_t(e.tail), std::size_t(e.head), e.T_tail_head, odometry, false, ""});
  for (const NodePosition& p : found.positions)
    graph.positions.push_back({p.node.node, p.t_map, p.information, true, ""});
  graph.attitude.push_back({0, Vec3::UnitZ(), 0.01});
  return component<Solver>("sparse_lm", "{loss: cauchy}")->solve(graph, *make_context()).T_map_node;
}

/// Root mean square horizontal distance from where the nodes are in truth [m].
double error(const std::vector<SE3>& T_map_node, const GnssAlignment& found,
             const std::vector<SE3>& truth) {
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Vec3 p_enu = to_enu(place, map_to_geodetic(*found.georeference, T_map_node[i].t));
    squares += (T_map_enu * p_enu - truth[i].t).head<2>().squaredNorm() / double(truth.size());
  }
  return std::sqrt(squares);
}

TEST(GnssFactors, StraightensABentMap) {
  const auto truth = winding(251, 4);
  Mission mission = with_receiver(walked("a", truth, 4), T_map_enu,
                                  {.sigma = 2, .correlation_time = 10, .jump = 0.15});
  const Mission robot = walked("a", bent(truth, 0.001), 4);  // 125 m off at its end
  mission.nodes = robot.nodes;
  mission.edges = robot.edges;
  Atlas atlas = make_atlas({mission});
  GnssAlignment found = factors(atlas);
  ASSERT_TRUE(found.georeference) << found.reason;
  const double before = error(*atlas.missions[0].T_map_node, found, truth);
  EXPECT_GT(before, 8);
  auto poses = relaxed(atlas, found);
  EXPECT_LT(error(poses, found, truth), 0.5 * before);
  // The alignment of the bent map was a compromise; that of the straightened one is not.
  atlas.missions[0].T_map_node = std::make_shared<const std::vector<SE3>>(poses);
  found = factors(atlas);
  EXPECT_LT(error(relaxed(atlas, found), found, truth), 2.83);  // that of one fix
}

TEST(GnssFactors, PutsNodesWhereTheFixesAre) {
  const Mission mission =
      with_receiver(walked("a", winding(50, 4), 4), T_map_enu, {.lever_arm = Vec3(0.3, 0, 1)});
  const Atlas atlas = make_atlas({mission});
  const GnssAlignment found = factors(atlas, "{lever_arm: [0.3, 0, 1]}");
  ASSERT_TRUE(found.georeference) << found.reason;
  EXPECT_EQ(found.positions.size(), 50u);
  for (const NodePosition& p : found.positions)
    EXPECT_LT((p.t_map - atlas.T_map_node(p.node).t).norm(), 2e-2);
}

double information(const GnssAlignment& a) {  // of x over the whole path
  double sum = 0;
  for (const NodePosition& p : a.positions) sum += p.information(0, 0);
  return sum;
}

TEST(GnssFactors, CountsCorrelatedFixesOnce) {
  const auto poses = winding(251, 4);
  const auto at = [&](double rate, const std::string& yaml) {
    return factors(make_atlas({with_receiver(walked("a", poses, 4), T_map_enu,
                                             {.sigma = 2, .correlation_time = 20, .rate = rate})}),
                   yaml);
  };
  // 1000 s hold 25 pieces of twice 20 s, each worth one fix of 2 m, at any rate.
  EXPECT_NEAR(information(at(1, "{}")), 25 / 4.0, 1.5);
  EXPECT_NEAR(information(at(5, "{}")), 25 / 4.0, 1.5);
  EXPECT_NEAR(information(at(1, "{correlation_time: 0}")) / 250, 1, 0.25);
  EXPECT_NEAR(information(at(1, "{sigma_scale: 2}")) * 4, information(at(1, "{}")), 1e-6);
  const GnssAlignment weak = at(1, "{vertical_scale: 5}");
  const NodePosition& p = weak.positions[100];
  EXPECT_NEAR(p.information(0, 0) / p.information(2, 2), 4 * 25, 1e-6);  // the receiver says 4
}

TEST(GnssFactors, LeavesJumpsOut) {
  const auto poses = winding(251, 4);
  const Mission clean =
      with_receiver(walked("a", poses, 4), T_map_enu, {.sigma = 1, .correlation_time = 10});
  Mission jumping = clean;
  for (std::size_t i = 400; i < 430; ++i) jumping.fixes[i].latitude += 2e-4;  // 22 m
  const GnssAlignment a = factors(make_atlas({clean})), b = factors(make_atlas({jumping}));
  std::set<std::uint32_t> missing;
  for (const NodePosition& p : a.positions) missing.insert(p.node.node);
  for (const NodePosition& p : b.positions) missing.erase(p.node.node);
  EXPECT_GE(missing.size(), 6u);
  for (const std::uint32_t node : missing) EXPECT_TRUE(node >= 100 && node <= 108) << node;
}

TEST(GnssFactors, GivesNoPositionsWithoutAGeoreference) {
  Mission mission = with_receiver(make_mission("a", winding(10, 1)), T_map_enu, {.sigma = 5});
  const GnssAlignment found = factors(make_atlas({mission}));
  EXPECT_FALSE(found.georeference);
  EXPECT_TRUE(found.positions.empty());
  EXPECT_TRUE(factors(make_atlas({make_mission("a", winding(10, 1))})).positions.empty());
}

}  // namespace
}  // namespace cambium::testing
