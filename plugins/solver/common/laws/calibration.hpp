// SPDX-License-Identifier: BSD-3-Clause
// Odometry that states a wrong uncertainty.
#pragma once
#include "common/laws/bad_input.hpp"

namespace cambium::testing {
namespace {

double score(const Solution& s, const std::string& name) {
  for (const auto& [key, value] : s.scores)
    if (key == name) return value;
  return std::nan("");
}

/// A helix whose odometry states sigmas that are too large by these factors.
Helix misjudged(double translation, double rotation) {
  Helix helix(400);
  for (RelativeFactor& f : helix.graph.relative)
    if (!f.robust) f.information = information(translation * sigma_t, rotation * sigma_r);
  return helix;
}

TEST(SolverLaws, CalibratedOdometryHasTheSigmasOfItsNoise) {
  for (const auto& [translation, rotation] : {std::pair{5.0, 10.0}, {0.3, 4.0}, {1.0, 1.0}}) {
    const Solution s = solve(misjudged(translation, rotation).graph, "{odometry: calibrated}");
    EXPECT_NEAR(score(s, "odometry.0.translation") * translation, 1, 0.15);
    EXPECT_NEAR(score(s, "odometry.0.rotation") * rotation, 1, 0.15);
  }
}

TEST(SolverLaws, CalibrationBringsTheMapNearerToTheTruth) {
  const Helix helix = misjudged(0.2, 20);
  const double as_given = helix.largest_error(solve(helix.graph).T_map_node),
               calibrated =
                   helix.largest_error(solve(helix.graph, "{odometry: calibrated}").T_map_node),
               best = helix.largest_error(solve(misjudged(1, 1).graph).T_map_node);
  EXPECT_LT(calibrated, 0.9 * as_given);
  EXPECT_LT(calibrated, 1.1 * best);
}

TEST(SolverLaws, OdometryThatNoLoopTellsOfKeepsItsInformation) {
  Helix helix = misjudged(5, 5);
  std::erase_if(helix.graph.relative, [](const RelativeFactor& f) { return f.robust; });
  Listening context;
  const Solution s =
      component<Solver>(solver_under_test(), "{odometry: calibrated}")->solve(helix.graph, context);
  EXPECT_NE(context.warnings.find("begins at node 0"), std::string::npos) << context.warnings;
  EXPECT_TRUE(std::isnan(score(s, "odometry.0.translation")));
  EXPECT_EQ(s.T_map_node[399].t, solve(helix.graph).T_map_node[399].t);
}

}  // namespace
}  // namespace cambium::testing
