// SPDX-License-Identifier: BSD-3-Clause
// What is said of a solution: uncertainty, diagnostics, the certificate.
#pragma once
#include "common/laws/helix.hpp"

namespace cambium::testing {
namespace {

// Each step adds 4 cm^2 in x; a node that is held has no uncertainty. A second path halves it.
TEST(SolverLaws, MarginalsOfAChainGrowWithItsLength) {
  PoseGraph g;
  for (int i = 0; i < 6; ++i) {
    g.T_map_node.push_back({Quat::Identity(), Vec3(0, 0, 0)});
    g.ids.push_back(i);
    g.fixed.push_back(i == 0);
    if (i > 0)
      g.relative.push_back(
          {std::size_t(i) - 1, std::size_t(i), SE3{}, information(0.02, 0.001), false, ""});
  }
  g.marginals = {5, 0, 2};
  Solution s = solve(g);
  ASSERT_EQ(s.marginals.size(), 3u);
  EXPECT_NEAR(s.marginals[0](0, 0), 5 * 4e-4, 1e-9);
  EXPECT_NEAR(s.marginals[0](5, 5), 5 * 1e-6, 1e-12);
  EXPECT_EQ(s.marginals[1], Mat6(Mat6::Zero()));
  EXPECT_NEAR(s.marginals[2](1, 1), 2 * 4e-4, 1e-9);
  g.relative.push_back({0, 5, SE3{}, Mat6(information(0.02, 0.001) / 5.0), false, ""});
  EXPECT_NEAR(solve(g).marginals[0](0, 0), 5 * 4e-4 / 2, 1e-9);
}

TEST(SolverLaws, NamesTheNodeWhoseMarginalDoesNotExist) {
  PoseGraph g;
  g.T_map_node.assign(2, SE3{});
  g.ids = {70, 71};
  g.fixed = {true, false};
  g.relative.push_back({0, 1, SE3{}, Mat6::Zero(), false, "empty"});
  g.marginals = {1};
  try {
    solve(g);
    FAIL() << "nothing was thrown";
  } catch (const Error& e) {
    EXPECT_EQ(std::string(e.what()).rfind("node 71: ", 0), 0u) << e.what();
  }
}

TEST(SolverLaws, DiagnosticsTellOptimumFromStart) {
  const Helix helix(60);
  const auto gradient = [&](const std::string& yaml) {
    const Solution s = solve(helix.graph, yaml);
    EXPECT_EQ(s.scores.at(0).first, "gradient_norm");
    EXPECT_EQ(s.scores.at(1).first, "condition");
    EXPECT_GT(s.scores[1].second, 1);
    return s.scores[0].second;
  };
  const double stopped = gradient("{diagnostics: true, initialization: local, max_iterations: 1}");
  EXPECT_LT(gradient("{diagnostics: true}"), 1e-3 * stopped);
}

// However a library orders its terms and scales its rotations, it minimises the one cost.
TEST(SolverLaws, TheSolverAddsUpTheOneCost) {
  for (const char* const loss : {"none", "cauchy"}) {
    const PoseGraph g = every_kind_of_factor();
    const Solution s =
        solve(g, std::string("{diagnostics: true, loss_width: 50, loss: ") + loss + "}");
    ASSERT_EQ(s.scores.at(2).first, "solver_cost");
    if (std::string(loss) == "none")
      EXPECT_NEAR(s.scores[2].second / cost(g, s.T_map_node), 1, 1e-9);
    else
      EXPECT_LT(s.scores[2].second, cost(g, s.T_map_node));
  }
}

/// A ring of 20 poses whose given poses go round twice: a local minimum that no small step leaves.
PoseGraph twisted_ring() {
  PoseGraph g;
  const double step = 2 * M_PI / 20;
  for (std::size_t i = 0; i < 20; ++i) {
    g.T_map_node.push_back(SE3::from_yaw(2 * step * double(i)));
    g.ids.push_back(NodeId(i));
    g.fixed.push_back(i == 0);
    g.relative.push_back({i, (i + 1) % 20, SE3::from_yaw(step, Vec3(1, 0, 0)),
                          information(0.1, 0.02), false, "edge"});
  }
  return g;
}

TEST(SolverLaws, CertifiesTheOptimumAndNoOther) {
  const auto score = [](const Solution& s, const std::string& name) {
    for (const auto& [key, value] : s.scores)
      if (key == name) return value;
    return std::nan("");
  };
  const Solution best = solve(twisted_ring(), "{certify: true}");
  EXPECT_LT(cost(twisted_ring(), best.T_map_node), 1e-6);
  EXPECT_EQ(score(best, "certified"), 1);
  const Solution twisted = solve(twisted_ring(), "{certify: true, initialization: local}");
  EXPECT_GT(cost(twisted_ring(), twisted.T_map_node), 100);
  EXPECT_EQ(score(twisted, "certified"), 0);
  EXPECT_LT(score(twisted, "certificate.smallest_eigenvalue"), -1e-4);

  PoseGraph skewed = twisted_ring();
  skewed.relative[4].information(1, 1) *= 2;
  EXPECT_TRUE(std::isnan(score(solve(skewed, "{certify: true}"), "certified")));
}

}  // namespace
}  // namespace cambium::testing
