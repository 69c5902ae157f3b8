// SPDX-License-Identifier: BSD-3-Clause
#include "path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cambium::pcm {
namespace {

Sigma scaled(const Sigma& per_metre, double metres) {
  return {per_metre.translation * metres, per_metre.rotation * metres};
}

/// The covariance of each step k -> k + 1 by its edge; the first edge of the file wins.
std::vector<std::optional<Mat6>> edge_covariances(const Mission& mission) {
  std::vector<std::optional<Mat6>> out(mission.nodes.size());
  for (const Edge& e : mission.edges) {
    if (e.kind != EdgeKind::odometry && e.kind != EdgeKind::loop) continue;
    const auto tail = mission.index_of(e.tail), head = mission.index_of(e.head);
    if (!tail || !head || std::max(*tail, *head) - std::min(*tail, *head) != 1) continue;
    auto& step = out[std::min(*tail, *head)];
    if (step) continue;
    const Mat6 S = covariance_of(e.T_tail_head, e.information);
    step = *tail < *head ? S : through(e.T_tail_head, S);
  }
  return out;
}

/// No axis is less certain than the bound: edges without information say 1 m and 1 rad a step,
/// which would let every loop agree with every other.
Mat6 bounded(const Mat6& S, const Sigma& bound) {
  const double t = S.diagonal().head<3>().maxCoeff(), r = S.diagonal().tail<3>().maxCoeff();
  Mat6 scale = Mat6::Identity();
  scale.diagonal().head<3>() *= std::min(1.0, bound.translation / std::sqrt(t));
  scale.diagonal().tail<3>() *= std::min(1.0, bound.rotation / std::sqrt(r));
  return scale * S * scale;
}

}  // namespace

Path::Path(const Mission& mission, const Drift& drift) : drift_(drift) {
  const auto& nodes = mission.nodes;
  const auto steps = edge_covariances(mission);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    T_first_node_.push_back(nodes.front().T_mission_node.inverse() * nodes[k].T_mission_node);
    if (k == 0) {
      sum_.push_back(Mat6::Zero());
      travelled_.push_back(0);
      continue;
    }
    const double step = (T_first_node_[k].t - T_first_node_[k - 1].t).norm();
    // A robot that stands still and turns is not certain of it.
    const Sigma bound = scaled(drift.bound, std::max(step, 0.5));
    const Mat6 S = steps[k - 1] ? bounded(*steps[k - 1], bound) : diagonal(bound);
    sum_.push_back(sum_.back() + through(T_first_node_[k], S));
    travelled_.push_back(travelled_.back() + step);
  }
}

Mat6 Path::covariance(std::size_t i, std::size_t j) const {
  const Mat6 between = sum_[std::max(i, j)] - sum_[std::min(i, j)];
  return through(T_first_node_[j].inverse(), between) +
         diagonal(scaled(drift_.systematic, length(i, j)));
}

double Path::length(std::size_t i, std::size_t j) const {
  return std::abs(travelled_[j] - travelled_[i]);
}

}  // namespace cambium::pcm
