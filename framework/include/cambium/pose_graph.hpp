// SPDX-License-Identifier: BSD-3-Clause
// What a solver sees: flat arrays, and the one cost that all solvers minimise.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "cambium/mission.hpp"
#include "cambium/se3.hpp"

namespace cambium {

/// Constraint between two poses. Indices point into PoseGraph::T_map_node.
struct RelativeFactor {
  std::size_t tail = 0, head = 0;
  SE3 T_tail_head;
  Mat6 information = Mat6::Identity();
  bool robust = false;  ///< a loop: the robust loss applies; odometry is trusted
  std::string label;    ///< for messages: file:line, or the pair of nodes
};

/// Roll and pitch only: `up_node` is the direction of gravity's opposite, seen in the node's frame.
/// r = (R_map_node^T z - up_node) projected on the plane normal to up_node; free of yaw, position.
struct AttitudeFactor {
  std::size_t node = 0;
  Vec3 up_node = Vec3::UnitZ();
  double sigma = 0;  ///< [rad]
};

/// Pose prior; the residual is that of a relative factor whose tail is the map frame.
struct PriorFactor {
  std::size_t node = 0;
  SE3 T_map_node;
  Mat6 information = Mat6::Identity();
  std::string label;
};

/// Position prior (GNSS): r = t_map_node - t.
struct PositionFactor {
  std::size_t node = 0;
  Vec3 t_map = Vec3::Zero();
  Mat3 information = Mat3::Identity();
  bool robust = true;
  std::string label;
};

struct PoseGraph {
  std::vector<SE3> T_map_node;     ///< initial estimate
  std::vector<NodeId> ids;         ///< for messages, in the fused numbering
  std::vector<bool> fixed;         ///< held where they are: the gauge, one per component
  std::vector<RelativeFactor> relative;
  std::vector<AttitudeFactor> attitude;
  std::vector<PriorFactor> priors;
  std::vector<PositionFactor> positions;
  std::vector<std::size_t> marginals;  ///< nodes whose covariance is wanted
};

struct Solution {
  std::vector<SE3> T_map_node;
  std::vector<double> weight;  ///< per relative factor, 0..1; 1 where no robust loss applies
  int iterations = 0;
  bool converged = false;
  std::string message;  ///< why it stopped
  std::vector<Score> scores;  ///< for the report: "gradient_norm", "condition", ...
  /// One per PoseGraph::marginals, or none when the solver gives none: of (translation in the map
  /// frame [m]; rotation in the node's [rad]), given the nodes that are held.
  std::vector<Mat6> marginals;
};

/// r = [R_tail'(t_head - t_tail) - t ; 2 vec(q^-1 q_tail^-1 q_head)], the scalar part made >= 0.
Vec6 residual(const SE3& T_tail_head, const SE3& T_map_tail, const SE3& T_map_head);

/// F without robust loss: the sum of r' Omega r over all factors, each weighted by `weight` (empty
/// = all 1; per relative factor). Every solver's result is judged by this function.
double cost(const PoseGraph& graph, const std::vector<SE3>& T_map_node,
            const std::vector<double>& weight = {});

/// The connected component of each node over the relative factors, numbered from 0 in the order of
/// their first node.
std::vector<std::size_t> components(const PoseGraph& graph);

}  // namespace cambium
