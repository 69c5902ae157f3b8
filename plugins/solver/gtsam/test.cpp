// SPDX-License-Identifier: BSD-3-Clause
#include "common/solver_laws.hpp"

const char* cambium::testing::solver_under_test() { return "gtsam"; }

namespace cambium::testing {
namespace {

double found(const PoseGraph& graph, const std::string& yaml) {
  const Solution s = solve(graph, yaml);
  EXPECT_TRUE(s.converged) << yaml << ": " << s.message;
  return cost(graph, s.T_map_node);
}

// The second graph hangs on a prior of its eleventh node, before which nothing is tied.
TEST(Isam2, EndsWhereTheBatchEnds) {
  const std::pair<PoseGraph, std::string> cases[] = {{Helix(200).graph, "1"},
                                                     {every_kind_of_factor(), "11"}};
  for (const auto& [graph, at_once] : cases)
    for (const std::string loss : {"none", "huber"}) {
      const std::string yaml = ", loss: " + loss + "}";
      const double batch = found(graph, "{method: batch" + yaml);
      EXPECT_NEAR(found(graph, "{method: isam2" + yaml) / batch, 1, 1e-6) << loss;
      EXPECT_NEAR(found(graph, "{method: isam2, nodes_an_update: " + at_once + yaml) / batch, 1,
                  1e-6);
    }
}

TEST(Isam2, ReachesAReferenceOptimum) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  const auto graph = pose_graph_from(read_g2o(data / "sphere2500" / "sphere2500.g2o"));
  EXPECT_NEAR(found(graph, "{method: isam2}") / 1351.215697, 1, 1e-6);
}

TEST(Isam2, NamesANodeThatIsNotTied) {
  const Solution s = solve(every_kind_of_factor(), "{method: isam2, nodes_an_update: 1}");
  EXPECT_FALSE(s.converged);
  EXPECT_NE(s.message.find("node 0 of the graph is not"), std::string::npos) << s.message;
}

}  // namespace
}  // namespace cambium::testing
