// SPDX-License-Identifier: BSD-3-Clause
#include "factor_graph.hpp"

namespace cambium::gtsam_solver {

FactorGraph factor_graph(const pose_solver::Problem& problem, const std::vector<SE3>& start,
                         const pose_solver::Weights& weights, const pose_solver::Loss& loss) {
  const auto& graph = problem.graph;
  FactorGraph out;
  const auto end = [&](std::size_t node) {
    return problem.held[node] ? End{node, to_gtsam(start[node])} : End{node, {}};
  };
  const auto noise_of = [&](std::size_t rows, bool robust) {
    return noise(rows, robust ? loss : pose_solver::Loss());
  };
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    if (f.tail == f.head || weights.relative[k] == 0) continue;  // no pose moves it
    if (problem.held[f.tail] && problem.held[f.head]) continue;
    out.factors.emplace_shared<RelativeResidual>(end(f.tail), end(f.head), f.T_tail_head,
                                                 f.information, weights.relative[k],
                                                 noise_of(6, f.robust));
  }
  for (const auto& f : graph.priors)
    if (!problem.held[f.node])
      out.factors.emplace_shared<RelativeResidual>(End{0, gtsam::Pose3()}, end(f.node),
                                                   f.T_map_node, f.information, 1.0,
                                                   noise_of(6, false));
  for (const auto& f : graph.attitude)
    if (!problem.held[f.node]) out.factors.emplace_shared<AttitudeResidual>(f.node, f);
  for (std::size_t k = 0; k < graph.positions.size(); ++k)
    if (const auto& f = graph.positions[k]; !problem.held[f.node])
      out.factors.emplace_shared<PositionResidual>(f.node, f, weights.positions[k],
                                                   noise_of(3, f.robust));
  for (const gtsam::Key key : out.factors.keys()) out.start.insert(key, to_gtsam(start[key]));
  return out;
}

std::vector<SE3> poses(const std::vector<SE3>& start, const gtsam::Values& values) {
  std::vector<SE3> out = start;
  for (const gtsam::Key key : values.keys()) out[key] = from_gtsam(values.at<gtsam::Pose3>(key));
  return out;
}

}  // namespace cambium::gtsam_solver
