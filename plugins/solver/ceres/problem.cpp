// SPDX-License-Identifier: BSD-3-Clause
#include "problem.hpp"

#include <cmath>

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
    : kind_(loss),
      loss_(loss.robust() && !loss.switchable() ? std::make_unique<CeresLoss>(loss) : nullptr),
      problem_(problem_options()) {
  blocks_.reserve(start.size());
  for (const SE3& T : start) blocks_.push_back(to_block(T));
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    problem_.AddParameterBlock(blocks_[i].data(), 7, &manifold_);
    if (held[i]) problem_.SetParameterBlockConstant(blocks_[i].data());
  }
  add_relative(graph, held, weights.relative);
  add_absolute(graph, weights.positions);
}

std::vector<SE3> PoseProblem::poses() const {
  std::vector<SE3> out;
  out.reserve(blocks_.size());
  for (const PoseBlock& b : blocks_) out.push_back(from_block(b));
  return out;
}

void PoseProblem::add(const ceres::CostFunction& cost, bool robust, std::vector<double*> blocks) {
  const ceres::CostFunction* added = &cost;
  if (robust && kind_.switchable()) {
    added = &switchable_.emplace_back(cost, std::sqrt(kind_.width_squared()));
    blocks.push_back(&switches_.emplace_back(1.0));
  }
  problem_.AddResidualBlock(const_cast<ceres::CostFunction*>(added), robust ? loss_.get() : nullptr,
                            blocks);
}

void PoseProblem::add_relative(const PoseGraph& graph, const std::vector<bool>& held,
                               const std::vector<double>& weight) {
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    const bool moves = f.tail != f.head && !(held[f.tail] && held[f.head]);
    if (!moves || weight[k] == 0) continue;
    add(relative_.emplace_back(f.T_tail_head, f.information, weight[k]), f.robust,
        {blocks_[f.tail].data(), blocks_[f.head].data()});
  }
}

void PoseProblem::add_absolute(const PoseGraph& graph, const std::vector<double>& position_weight) {
  if (!graph.priors.empty()) {
    problem_.AddParameterBlock(origin_.data(), 7, &manifold_);
    problem_.SetParameterBlockConstant(origin_.data());
  }
  for (const auto& f : graph.priors)
    add(relative_.emplace_back(f.T_map_node, f.information, 1.0), false,
        {origin_.data(), blocks_[f.node].data()});
  for (const auto& f : graph.attitude)
    add(attitude_.emplace_back(f), false, {blocks_[f.node].data()});
  for (std::size_t k = 0; k < graph.positions.size(); ++k)
    if (const auto& f = graph.positions[k]; position_weight[k] != 0)
      add(positions_.emplace_back(f, position_weight[k]), f.robust, {blocks_[f.node].data()});
}

}  // namespace cambium::ceres_solver
