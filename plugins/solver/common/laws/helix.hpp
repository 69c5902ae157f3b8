// SPDX-License-Identifier: BSD-3-Clause
// The graph that most laws of the solvers look at.
#pragma once
#include <cmath>
#include <random>

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

/// Full information matrices, a prior, a position, attitudes, and no fixed node.
PoseGraph every_kind_of_factor() {
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
  return g;
}

}  // namespace
}  // namespace cambium::testing
