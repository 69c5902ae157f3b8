// SPDX-License-Identifier: BSD-3-Clause
// False loops let go, true ones do not.
#pragma once
#include <fstream>

#include "cambium/dialect.hpp"
#include "common/laws/helix.hpp"

namespace cambium::testing {
namespace {

class ThousandFalseLoops : public ::testing::TestWithParam<const char*> {};

// data/pose_graphs/sphere2500_outliers: every true loop is kept and every false one goes.
TEST_P(ThousandFalseLoops, AreRejected) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  const auto clean = pose_graph_from(read_g2o(data / "sphere2500" / "sphere2500.g2o"));
  const auto dirty = pose_graph_from(read_g2o(data / "sphere2500_outliers" / "n1000_local.g2o"));
  const auto truth = solve(clean).T_map_node;
  const Solution s = solve(dirty, std::string("{loss: ") + GetParam() + "}");
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += (truth[i].t - s.T_map_node[i].t).squaredNorm();
  EXPECT_LT(std::sqrt(sum / double(truth.size())), 0.02);  // [m]
  std::ifstream labels(data / "sphere2500_outliers" / "n1000_local.labels.txt");
  std::string comment;
  std::getline(labels, comment);
  for (std::size_t k = 0; k < dirty.relative.size(); ++k) {
    if (!dirty.relative[k].robust) continue;
    NodeId tail = 0, head = 0;
    int outlier = 0;
    ASSERT_TRUE(labels >> tail >> head >> outlier);
    EXPECT_EQ(s.weight[k] < 0.5, outlier == 1) << tail << "-" << head;
  }
}
INSTANTIATE_TEST_SUITE_P(Losses, ThousandFalseLoops, ::testing::Values("dcs", "gnc"));

// The chordal start of this helix has no suspicious loop, but is not the minimum yet.
TEST(SolverLaws, GncWithoutFalseLoopsIsTheMinimum) {
  const Helix helix(100);
  const Solution s = solve(helix.graph, "{loss: gnc, loss_width: 6}");
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_EQ(s.weight, std::vector<double>(helix.graph.relative.size(), 1.0));
  EXPECT_NEAR(cost(helix.graph, s.T_map_node) / cost(helix.graph, solve(helix.graph).T_map_node), 1,
              1e-9);
}

class RobustLoss : public ::testing::TestWithParam<const char*> {};

TEST_P(RobustLoss, FalseLoopsHaveLittleWeightAndTrueOnesMost) {
  Helix helix(200);
  const std::size_t first_false = helix.graph.relative.size();
  std::mt19937_64 engine(11);
  for (std::size_t k = 0; k < 40; ++k) {
    const std::size_t tail = engine() % 90, head = tail + 5 + engine() % 100;
    helix.graph.relative.push_back({tail, head, SE3::exp(noise(engine, 5, 1)),
                                    information(sigma_t, sigma_r), true, "false loop"});
  }
  const Solution s = solve(helix.graph, std::string("{loss: ") + GetParam() + "}");
  EXPECT_TRUE(s.converged) << s.message;
  std::size_t loops = 0, kept = 0;
  for (std::size_t k = 0; k < helix.graph.relative.size(); ++k) {
    if (!helix.graph.relative[k].robust) {
      EXPECT_EQ(s.weight[k], 1) << k;
    } else if (k >= first_false) {
      EXPECT_LT(s.weight[k], 0.01) << k;
    } else {
      ++loops;
      kept += s.weight[k] > 0.1;
    }
  }
  EXPECT_GE(double(kept), 0.85 * double(loops));
  EXPECT_LT(helix.largest_error(s.T_map_node), 0.3);
}
INSTANTIATE_TEST_SUITE_P(Losses, RobustLoss,
                         ::testing::Values("cauchy", "geman_mcclure", "dcs", "switchable", "gnc"));

// The weights of the losses, by their formulas, on a loop that stays 4 sigma off: both its ends
// are fixed.
TEST(SolverLaws, ReportsTheWeightOfEachLoss) {
  PoseGraph g;
  g.T_map_node = {SE3{}, SE3{Quat::Identity(), Vec3(4, 0, 0)}};
  g.ids = {0, 1};
  g.fixed = {true, true};
  g.relative.push_back({0, 1, SE3{}, Mat6::Identity(), true, ""});
  const auto weight = [&](const std::string& yaml) { return solve(g, yaml).weight.at(0); };
  EXPECT_EQ(weight("{loss: none}"), 1);
  EXPECT_NEAR(weight("{loss: huber, loss_width: 2}"), 0.5, 1e-14);
  EXPECT_EQ(weight("{loss: huber, loss_width: 5}"), 1);
  EXPECT_NEAR(weight("{loss: cauchy, loss_width: 2}"), 1 / (1 + 16.0 / 4), 1e-14);
  EXPECT_NEAR(weight("{loss: geman_mcclure, loss_width: 2}"), std::pow(4 / 20.0, 2), 1e-14);
  EXPECT_NEAR(weight("{loss: dcs, loss_width: 2}"), std::pow(8 / 20.0, 2), 1e-14);
  EXPECT_EQ(weight("{loss: dcs, loss_width: 5}"), 1);
  EXPECT_NEAR(weight("{loss: switchable, loss_width: 2}"), std::pow(4 / 20.0, 2), 1e-14);
  EXPECT_NEAR(weight("{loss: switchable, loss_width: 5}"), std::pow(25 / 41.0, 2), 1e-14);
}

/// A node that odometry holds at 0 and a loop pulls to `x`, both with sigma 1 m.
PoseGraph pulled_to(double x) {
  PoseGraph g;
  g.T_map_node = {SE3{}, SE3{}};
  g.ids = {0, 1};
  g.fixed = {true, false};
  g.relative.push_back({0, 1, SE3{}, Mat6::Identity(), false, ""});
  g.relative.push_back({0, 1, SE3{Quat::Identity(), Vec3(x, 0, 0)}, Mat6::Identity(), true, ""});
  return g;
}

// rho = 2 k sqrt(s) - k^2 pulls with k, not with r.
TEST(SolverLaws, HuberIsTheMinimumOfItsFormula) {
  const Solution s = solve(pulled_to(10), "{loss: huber, loss_width: 1.5, tolerance: 1e-14}");
  EXPECT_NEAR(s.T_map_node[1].t.x(), 1.5, 1e-5);
}

// A switch b costs w^2 (1 - b)^2 and leaves b^2 s of the loop: the minimum over both unknowns, by
// trying all of them. DCS lets go of nothing below w sigmas and of more above.
TEST(SolverLaws, SwitchableIsTheMinimumOverPosesAndSwitches) {
  const double target = 4, w = 2;
  double best_x = 0, best_b = 0, least = 1e9;
  for (double x = 0; x <= target; x += 1e-3)
    for (double b = 0; b <= 1; b += 1e-3) {
      const double r = b * (target - x), off = w * (1 - b), F = x * x + r * r + off * off;
      if (F < least) least = F, best_x = x, best_b = b;
    }
  const auto at = [&](const std::string& loss) {
    return solve(pulled_to(target), "{loss_width: 2, tolerance: 1e-12, loss: " + loss + "}");
  };
  const Solution s = at("switchable"), dcs = at("dcs");
  EXPECT_NEAR(s.T_map_node[1].t.x(), best_x, 2e-3);
  EXPECT_NEAR(s.weight[1], best_b * best_b, 4e-3);
  EXPECT_GT(std::abs(dcs.T_map_node[1].t.x() - best_x), 0.05);
}

}  // namespace
}  // namespace cambium::testing
