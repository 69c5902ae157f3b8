// SPDX-License-Identifier: BSD-3-Clause
#include "common/start.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/chordal.hpp"
#include "common/costs.hpp"

namespace cambium::pose_solver {
namespace {

/// The factors without robust loss, and of the others a spanning forest, first come first taken.
std::vector<bool> backbone(const PoseGraph& graph) {
  std::vector<std::size_t> parent(graph.T_map_node.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::vector<bool> use(graph.relative.size());
  for (const bool robust : {false, true})
    for (std::size_t k = 0; k < use.size(); ++k) {
      const auto& f = graph.relative[k];
      if (f.robust != robust) continue;
      const std::size_t a = root(f.tail), b = root(f.head);
      use[k] = !robust || a != b;
      parent[std::max(a, b)] = std::min(a, b);
    }
  return use;
}

/// What the absolute factors say about where a component is.
struct Absolute {
  std::vector<Vec3> from, to;  ///< a node's position now, and in the map
  SE3 T_new_old;               ///< by the first pose prior
  bool prior = false;
};

std::vector<Absolute> absolutes(const PoseGraph& graph, const std::vector<std::size_t>& component,
                                const std::vector<SE3>& poses) {
  std::vector<Absolute> out(poses.size());
  for (const auto& f : graph.priors) {
    auto& a = out[component[f.node]];
    if (!a.prior) a.T_new_old = f.T_map_node * poses[f.node].inverse();
    a.prior = true;
    a.from.push_back(poses[f.node].t), a.to.push_back(f.T_map_node.t);
  }
  for (const auto& f : graph.positions) {
    auto& a = out[component[f.node]];
    a.from.push_back(poses[f.node].t), a.to.push_back(f.t_map);
  }
  return out;
}

/// Least squares over the points (Umeyama 1991, without scale) when they fix a rotation; else the
/// prior; else the mean offset.
SE3 rigid_move(const Absolute& a) {
  if (a.from.empty()) return {};
  const auto n = Eigen::Index(a.from.size());
  Eigen::Matrix3Xd from(3, n), to(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    from.col(i) = a.from[std::size_t(i)];
    to.col(i) = a.to[std::size_t(i)];
  }
  const Eigen::Vector3d offset = (to - from).rowwise().mean();
  const Eigen::Matrix3Xd centred = from.colwise() - from.rowwise().mean();
  const Eigen::Matrix3d scatter = centred * centred.transpose();
  const Eigen::Vector3d spread =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(scatter, Eigen::EigenvaluesOnly).eigenvalues();
  if (spread(1) > 1e-6 * spread(2)) return SE3::from_matrix(Eigen::umeyama(from, to, false));
  return a.prior ? a.T_new_old : SE3{Quat::Identity(), offset};
}

/// Chordal poses; a component that nothing holds is relaxed from its first node, then moved as a
/// whole to where its absolute factors say.
std::vector<SE3> relaxed(const Problem& problem, const std::vector<bool>& use) {
  const auto& [graph, component, held, elimination] = problem;
  std::vector<bool> anchored = held, tied(held.size());
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i]) tied[component[i]] = true;
  std::vector<bool> loose(held.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (tied[component[i]]) continue;
    anchored[i] = tied[component[i]] = loose[component[i]] = true;
  }
  const bool all = std::find(use.begin(), use.end(), false) == use.end();
  auto poses = anchored == held && all
                   ? chordal_poses(graph, elimination, use)
                   : chordal_poses(graph, Elimination(graph, anchored, use), use);
  if (poses.empty()) return poses;
  const auto absolute = absolutes(graph, component, poses);
  std::vector<SE3> move(held.size());
  for (std::size_t c = 0; c < move.size(); ++c)
    if (loose[c]) move[c] = rigid_move(absolute[c]);
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (loose[component[i]]) poses[i] = move[component[i]] * poses[i];
  return poses;
}

}  // namespace

std::vector<Poses> chordal_starts(const Problem& problem, const Loss& loss) {
  const auto& graph = problem.graph;
  const std::vector<bool> all(graph.relative.size(), true), trusted = backbone(graph);
  std::vector<Poses> out;
  out.push_back(relaxed(problem, all));
  if (loss.robust() && trusted != all) out.push_back(relaxed(problem, trusted));
  std::erase_if(out, [](const Poses& poses) { return poses.empty(); });  // not solvable
  return out;
}

Poses cheapest(const Problem& problem, const std::vector<Poses>& candidates, const Loss& loss) {
  const auto& [graph, component, held, elimination] = problem;
  const Weights weights = unit_weights(graph);
  Poses best = candidates.front();
  auto best_costs = robust_costs(graph, component, best, weights, loss);
  for (const Poses& poses : candidates) {
    const auto costs = robust_costs(graph, component, poses, weights, loss);
    const auto better = [&](std::size_t c) { return costs[c] < best_costs[c]; };
    for (std::size_t i = 0; i < best.size(); ++i)
      if (better(component[i])) best[i] = poses[i];
    for (std::size_t c = 0; c < costs.size(); ++c)
      if (better(c)) best_costs[c] = costs[c];
  }
  return best;
}

}  // namespace cambium::pose_solver
