// SPDX-License-Identifier: BSD-3-Clause
// Broken graphs, limits and interruptions.
#pragma once
#include "common/laws/helix.hpp"
#include "support/plain_context.hpp"

namespace cambium::testing {
namespace {

/// Keeps what is said to it.
class Listening final : public PlainContext {
 public:
  void log(LogLevel level, std::string_view m) const override {
    if (level == LogLevel::warning) warnings += m;
  }
  bool cancelled() const override { return asked_++ >= cancel_after; }
  int cancel_after = 1 << 30;
  mutable std::string warnings;

 private:
  mutable int asked_ = 0;
};

TEST(SolverLaws, IndefiniteInformationIsProjectedAndNamed) {
  Helix helix(40);
  PoseGraph projected = helix.graph;
  helix.graph.relative[7].information(2, 2) = -3;
  helix.graph.relative[7].label = "graph.g2o:99";
  projected.relative[7].information(2, 2) = 0;
  Listening context;
  const auto solver = component<Solver>(solver_under_test());
  const Solution s = solver->solve(helix.graph, context);
  EXPECT_NE(context.warnings.find("graph.g2o:99"), std::string::npos) << context.warnings;
  EXPECT_NE(context.warnings.find("-3"), std::string::npos) << context.warnings;
  const auto expected = solve(projected).T_map_node;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT((s.T_map_node[i].t - expected[i].t).norm(), 1e-9);
}

std::string warnings_about(const PoseGraph& graph) {
  Listening context;
  const Solution s = component<Solver>(solver_under_test())->solve(graph, context);
  for (const SE3& T : s.T_map_node) EXPECT_TRUE(T.finite());
  const double F = cost(graph, s.T_map_node);
  EXPECT_GE(F, 0);
  EXPECT_LE(F, cost(graph, graph.T_map_node));
  return context.warnings;
}

TEST(SolverLaws, NamesSingularInformationAndCopies) {
  Helix helix(40);
  EXPECT_EQ(warnings_about(helix.graph), "");
  helix.graph.relative[5].information(4, 4) = 0;
  helix.graph.relative[5].label = "graph.g2o:17";
  helix.graph.relative.push_back(helix.graph.relative[9]);
  helix.graph.relative.back().label = "graph.g2o:80";
  const std::string said = warnings_about(helix.graph);
  EXPECT_NE(said.find("singular"), std::string::npos) << said;
  EXPECT_NE(said.find("graph.g2o:17"), std::string::npos) << said;
  EXPECT_NE(said.find("graph.g2o:80 is a copy of 9-10"), std::string::npos) << said;
}

// Where odometry is missing a part has its own gauge; a loop across would tie it.
TEST(SolverLaws, NamesThePartsThatNothingTies) {
  Helix helix(15);  // no loops yet
  helix.graph.relative.erase(helix.graph.relative.begin() + 9);
  const std::string said = warnings_about(helix.graph);
  EXPECT_NE(said.find("node 10 and the 4 tied to it"), std::string::npos) << said;
}

TEST(SolverLaws, OnlyIndefiniteInformationStillGivesFinitePoses) {
  Helix helix(40);
  for (auto& f : helix.graph.relative) f.information *= -1;
  EXPECT_NE(warnings_about(helix.graph).find("and 44 more"), std::string::npos);
}

TEST(SolverLaws, CancelsBetweenIterations) {
  const Helix helix(60);
  for (const int after : {0, 1, 2}) {
    Listening context;
    context.cancel_after = after;
    EXPECT_THROW(component<Solver>(solver_under_test())->solve(helix.graph, context), Cancelled)
        << after;
  }
}

TEST(SolverLaws, StopsAtTheIterationLimitAndSaysSo) {
  const Helix helix(100);
  const Solution s = solve(helix.graph, "{max_iterations: 1, initialization: local}");
  EXPECT_FALSE(s.converged);
  EXPECT_EQ(s.iterations, 1);
  EXPECT_FALSE(s.message.empty());
  EXPECT_LE(cost(helix.graph, s.T_map_node), cost(helix.graph, helix.graph.T_map_node));
}

TEST(SolverLaws, GraphsWithNothingToDo) {
  EXPECT_TRUE(solve(PoseGraph{}).T_map_node.empty());
  PoseGraph one;
  one.T_map_node = {SE3::from_yaw(1)};
  one.ids = {5};
  one.fixed = {true};
  one.relative.push_back({0, 0, SE3::from_yaw(0.5), Mat6::Identity(), true, "self"});
  const Solution s = solve(one, "{loss: huber}");
  EXPECT_EQ(s.T_map_node[0].q.coeffs(), one.T_map_node[0].q.coeffs());
  EXPECT_EQ(s.weight.size(), 1u);
}

TEST(SolverLaws, LoopsWithoutInformationChangeNothing) {
  Helix helix(40);
  const auto expected = solve(helix.graph).T_map_node;
  helix.graph.relative.push_back({3, 30, SE3{}, Mat6::Zero(), true, "empty"});
  const auto poses = solve(helix.graph).T_map_node;
  for (std::size_t i = 0; i < poses.size(); ++i)
    EXPECT_LT((poses[i].t - expected[i].t).norm(), 1e-5);
}

/// The message of the numeric error that solving throws.
std::string refusal(const PoseGraph& graph) {
  try {
    solve(graph);
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::numeric);
    return e.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return {};
}

TEST(SolverLaws, NamesWhatIsNotFinite) {
  const Helix helix(10);
  const double nan = std::nan("");
  PoseGraph g = helix.graph;
  g.T_map_node[3].t.x() = nan;
  EXPECT_EQ(refusal(g).rfind("node 3: ", 0), 0u) << refusal(g);
  g = helix.graph;
  g.relative[4].T_tail_head.q.coeffs().setZero();
  EXPECT_EQ(refusal(g).rfind("4-5: ", 0), 0u) << refusal(g);
  g = helix.graph;
  g.relative[2].information(1, 1) = nan;
  EXPECT_EQ(refusal(g).rfind("2-3: ", 0), 0u) << refusal(g);
  g = helix.graph;
  g.relative[2].head = 10;
  EXPECT_EQ(refusal(g).rfind("2-3: ", 0), 0u) << refusal(g);
  g = helix.graph;
  g.attitude.push_back({0, Vec3::UnitZ(), 0});
  EXPECT_EQ(refusal(g).rfind("attitude factor 0: ", 0), 0u) << refusal(g);
}

}  // namespace
}  // namespace cambium::testing
