// SPDX-License-Identifier: BSD-3-Clause
#include "problem.hpp"

namespace cambium::ceres_solver {
namespace {

ceres::Problem::Options problem_options() {
  ceres::Problem::Options o;
  o.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  o.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  o.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  o.disable_all_safety_checks = true;  // checked() has looked already
  return o;
}

}  // namespace

PoseProblem::PoseProblem(const PoseGraph& graph, const std::vector<SE3>& start,
                         const std::vector<bool>& held, const pose_solver::Weights& weights,
                         const pose_solver::Loss& loss)
    : loss_(loss.robust() ? std::make_unique<CeresLoss>(loss) : nullptr),
      problem_(problem_options()) {
  blocks_.reserve(start.size());
  for (const SE3& T : start) blocks_.push_back(to_block(T));
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    problem_.AddParameterBlock(blocks_[i].data(), 7, &manifold_);
    if (held[i]) problem_.SetParameterBlockConstant(blocks_[i].data());
  }
  add_relative(graph, weights.relative);
  add_absolute(graph, weights.positions);
}

std::vector<SE3> PoseProblem::poses() const {
  std::vector<SE3> out;
  out.reserve(blocks_.size());
  for (const PoseBlock& b : blocks_) out.push_back(from_block(b));
  return out;
}

void PoseProblem::add_relative(const PoseGraph& graph, const std::vector<double>& weight) {
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    if (f.tail == f.head || weight[k] == 0) continue;  // constant: no pose moves it
    problem_.AddResidualBlock(&relative_.emplace_back(f.T_tail_head, f.information, weight[k]),
                              loss_for(f.robust), blocks_[f.tail].data(), blocks_[f.head].data());
  }
}

void PoseProblem::add_absolute(const PoseGraph& graph, const std::vector<double>& position_weight) {
  if (!graph.priors.empty()) {
    problem_.AddParameterBlock(origin_.data(), 7, &manifold_);
    problem_.SetParameterBlockConstant(origin_.data());
  }
  for (const auto& f : graph.priors)
    problem_.AddResidualBlock(&relative_.emplace_back(f.T_map_node, f.information, 1.0), nullptr,
                              origin_.data(), blocks_[f.node].data());
  for (const auto& f : graph.attitude)
    problem_.AddResidualBlock(&attitude_.emplace_back(f), nullptr, blocks_[f.node].data());
  for (std::size_t k = 0; k < graph.positions.size(); ++k) {
    const auto& f = graph.positions[k];
    problem_.AddResidualBlock(&positions_.emplace_back(f, position_weight[k]), loss_for(f.robust),
                              blocks_[f.node].data());
  }
}

}  // namespace cambium::ceres_solver
