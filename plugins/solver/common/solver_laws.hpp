// SPDX-License-Identifier: BSD-3-Clause
// What every solver must keep, whatever its method. A plugin's test includes this and defines
//   const char* cambium::testing::solver_under_test() { return "ceres"; }
#pragma once
#include <cmath>
#include <fstream>
#include <random>

#include "cambium/dialect.hpp"
#include "support/pose_graph.hpp"
#include "support/support.hpp"

namespace cambium::testing {

const char* solver_under_test();

namespace {

Solution solve(const PoseGraph& graph, const std::string& yaml = "{}", int threads = 1) {
  const auto context = make_context(threads);
  return component<Solver>(solver_under_test(), yaml)->solve(graph, *context);
}

Mat6 information(double sigma_t, double sigma_r) {
  Mat6 out = Mat6::Identity() / (sigma_t * sigma_t);
  out.bottomRightCorner<3, 3>() = Mat3::Identity() / (sigma_r * sigma_r);
  return out;
}

Vec6 noise(std::mt19937_64& engine, double sigma_t, double sigma_r) {
  std::normal_distribution<double> normal;
  Vec6 xi;
  for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? sigma_t : sigma_r) * normal(engine);
  return xi;
}

constexpr double sigma_t = 0.02, sigma_r = 0.005;

/// A helix of `n` poses, twenty a turn, with loops between the turns; the given poses are those of
/// the odometry, which drifts.
struct Helix {
  explicit Helix(std::size_t n, std::uint64_t seed = 3, double scale = 1) {
    std::mt19937_64 engine(seed);
    for (std::size_t i = 0; i < n; ++i)
      truth.push_back(SE3::from_yaw(
          0.314 * double(i), Vec3(5 * std::cos(0.314 * double(i)), 5 * std::sin(0.314 * double(i)),
                                  0.05 * double(i))));
    graph.T_map_node = {truth[0]};
    for (std::size_t i = 1; i < n; ++i) {
      add(i - 1, i, scale, engine);
      graph.T_map_node.push_back(graph.T_map_node.back() * graph.relative.back().T_tail_head);
    }
    for (std::size_t i = 20; i < n; i += 2) add(i - 20, i, scale, engine);
    for (std::size_t i = 0; i < n; ++i) graph.ids.push_back(NodeId(i));
    graph.fixed.assign(n, false);
    graph.fixed[0] = true;
  }

  void add(std::size_t tail, std::size_t head, double scale, std::mt19937_64& engine) {
    const SE3 T = truth[tail].inverse() * truth[head] *
                  SE3::exp(noise(engine, scale * sigma_t, scale * sigma_r));
    graph.relative.push_back({tail, head, T, information(sigma_t, sigma_r), head != tail + 1,
                              std::to_string(tail) + "-" + std::to_string(head)});
  }

  double largest_error(const std::vector<SE3>& poses) const {
    double worst = 0;
    for (std::size_t i = 0; i < truth.size(); ++i)
      worst = std::max(worst, (poses[i].t - truth[i].t).norm());
    return worst;
  }

  std::vector<SE3> truth;
  PoseGraph graph;
};

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

class ReferenceOptimum : public ::testing::TestWithParam<std::pair<const char*, double>> {};

// data/pose_graphs/REFERENCE.json, "canon"
TEST_P(ReferenceOptimum, IsReachedToAMillionth) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  const auto& [name, F] = GetParam();
  const auto graph = pose_graph_from(read_g2o(data / name / (std::string(name) + ".g2o")));
  const Solution s = solve(graph);
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_NEAR(cost(graph, s.T_map_node) / F, 1, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(PoseGraphs, ReferenceOptimum,
                         ::testing::Values(std::pair{"tinyGrid3D", 18.51936642},
                                           std::pair{"smallGrid3D", 1025.398056},
                                           std::pair{"parking-garage", 1.268384384},
                                           std::pair{"sphere2500", 1351.215697},
                                           std::pair{"torus3D", 24227.04556}));

TEST(SolverLaws, ChordalStartNeedsNoGivenPoses) {
  const auto data = real_data("pose_graphs");
  if (data.empty()) GTEST_SKIP() << "the archive pose_graphs is not beside the source tree";
  PoseGraph lost = pose_graph_from(read_g2o(data / "smallGrid3D" / "smallGrid3D.g2o"));
  std::mt19937_64 engine(1);
  for (std::size_t i = 1; i < lost.T_map_node.size(); ++i)
    lost.T_map_node[i] = SE3::exp(noise(engine, 10, 3));
  const Solution chordal = solve(lost), given = solve(lost, "{initialization: given}");
  EXPECT_NEAR(cost(lost, chordal.T_map_node) / 1025.398056, 1, 1e-6);
  EXPECT_LT(2 * chordal.iterations, given.iterations);
}

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
  Helix helix(60);
  PoseGraph& g = helix.graph;
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (auto& f : g.relative) {  // a random rotation mixes all terms
    Eigen::Matrix<double, 6, 6> A;
    for (double& a : A.reshaped()) a = normal(engine);
    const Eigen::Matrix<double, 6, 6> Q = A.householderQr().householderQ();
    f.information = Q * f.information * Q.transpose();
  }
  g.fixed[0] = false;
  g.priors.push_back({10, helix.truth[10], information(0.1, 0.05), "prior"});
  g.positions.push_back({50, helix.truth[50].t + Vec3(0.1, 0, 0), Mat3::Identity() * 25, true, ""});
  for (std::size_t i = 0; i < 60; i += 5)
    g.attitude.push_back({i, helix.truth[i].q.conjugate() * Vec3(0.01, 0, 1).normalized(), 0.02});
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

// The chordal start of this helix has no suspicious loop, but is not the minimum yet.
TEST(SolverLaws, GncWithoutFalseLoopsIsTheMinimum) {
  const Helix helix(100);
  const Solution s = solve(helix.graph, "{loss: gnc, loss_width: 6}");
  EXPECT_TRUE(s.converged) << s.message;
  EXPECT_EQ(s.weight, std::vector<double>(helix.graph.relative.size(), 1.0));
  EXPECT_NEAR(cost(helix.graph, s.T_map_node) / cost(helix.graph, solve(helix.graph).T_map_node), 1,
              1e-9);
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
                         ::testing::Values("cauchy", "geman_mcclure", "dcs", "gnc"));

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
}

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
  const double stopped = gradient("{diagnostics: true, initialization: given, max_iterations: 1}");
  EXPECT_LT(gradient("{diagnostics: true}"), 1e-3 * stopped);
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
  const Solution twisted = solve(twisted_ring(), "{certify: true, initialization: given}");
  EXPECT_GT(cost(twisted_ring(), twisted.T_map_node), 100);
  EXPECT_EQ(score(twisted, "certified"), 0);
  EXPECT_LT(score(twisted, "certificate.smallest_eigenvalue"), -1e-4);

  PoseGraph skewed = twisted_ring();
  skewed.relative[4].information(1, 1) *= 2;
  EXPECT_TRUE(std::isnan(score(solve(skewed, "{certify: true}"), "certified")));
}

TEST(SolverLaws,
     HuberIsTheMinimumOfItsFormula) {  // rho = 2 k sqrt(s) - k^2 pulls with k, not with r
  PoseGraph g;
  g.T_map_node = {SE3{}, SE3{}};
  g.ids = {0, 1};
  g.fixed = {true, false};
  g.relative.push_back({0, 1, SE3{}, Mat6::Identity(), false, ""});
  g.relative.push_back({0, 1, SE3{Quat::Identity(), Vec3(10, 0, 0)}, Mat6::Identity(), true, ""});
  const Solution s = solve(g, "{loss: huber, loss_width: 1.5, tolerance: 1e-14}");
  EXPECT_NEAR(s.T_map_node[1].t.x(), 1.5, 1e-5);
}

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

/// Keeps what is said to it.
class Listening final : public Context {
 public:
  void log(LogLevel level, std::string_view m) const override {
    if (level == LogLevel::warning) warnings += m;
  }
  bool cancelled() const override { return asked_++ >= cancel_after; }
  int threads() const override { return 1; }
  std::uint64_t seed() const override { return 1; }
  std::filesystem::path scratch() const override { return {}; }
  void parallel_for(std::size_t n, const std::function<void(std::size_t)>& body) const override {
    for (std::size_t i = 0; i < n; ++i) body(i);
  }
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
  const Solution s = solve(helix.graph, "{max_iterations: 1, initialization: given}");
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
