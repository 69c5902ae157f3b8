// SPDX-License-Identifier: BSD-3-Clause
#include "optimizer.hpp"

#include "edges.hpp"

namespace cambium::g2o_solver {
namespace {

/// Adds edges; the optimizer owns them and their kernels.
class Edges {
 public:
  Edges(g2o::SparseOptimizer& optimizer, const pose_solver::Loss& loss)
      : optimizer_(optimizer), loss_(loss) {}

  void relative(std::size_t tail, std::size_t head, const SE3& T_tail_head, const Mat6& information,
                bool robust) {
    auto* edge = new g2o::EdgeSE3;
    edge->setVertex(0, optimizer_.vertex(int(tail)));
    edge->setVertex(1, optimizer_.vertex(int(head)));
    edge->setMeasurement(to_isometry(T_tail_head));
    edge->setInformation(for_edge_se3(information, T_tail_head));
    add(edge, robust);
  }
  void unary(UnaryEdge* edge, std::size_t node, bool robust) {
    edge->setVertex(0, optimizer_.vertex(int(node)));
    add(edge, robust);
  }

 private:
  void add(g2o::OptimizableGraph::Edge* edge, bool robust) {
    if (robust && loss_.robust()) edge->setRobustKernel(new Kernel(loss_));
    optimizer_.addEdge(edge);
  }

  g2o::SparseOptimizer& optimizer_;
  const pose_solver::Loss& loss_;
};

void add_vertex(g2o::SparseOptimizer& optimizer, std::size_t id, const SE3& T, bool fixed) {
  auto* vertex = new g2o::VertexSE3;
  vertex->setId(int(id));
  vertex->setEstimate(to_isometry(T));
  vertex->setFixed(fixed);
  optimizer.addVertex(vertex);
}

}  // namespace

void fill(g2o::SparseOptimizer& optimizer, const pose_solver::Problem& problem,
          const std::vector<SE3>& start, const pose_solver::Weights& weights,
          const pose_solver::Loss& loss) {
  const auto& graph = problem.graph;
  const std::size_t origin = start.size();
  for (std::size_t i = 0; i < start.size(); ++i)
    add_vertex(optimizer, i, start[i], problem.held[i]);
  if (!graph.priors.empty()) add_vertex(optimizer, origin, SE3{}, true);
  Edges edges(optimizer, loss);
  for (std::size_t k = 0; k < graph.relative.size(); ++k) {
    const auto& f = graph.relative[k];
    const bool moves = f.tail != f.head && !(problem.held[f.tail] && problem.held[f.head]);
    if (!moves || weights.relative[k] == 0) continue;
    edges.relative(f.tail, f.head, f.T_tail_head, weights.relative[k] * f.information, f.robust);
  }
  for (const auto& f : graph.priors)
    if (!problem.held[f.node]) edges.relative(origin, f.node, f.T_map_node, f.information, false);
  for (const auto& f : graph.attitude)
    if (!problem.held[f.node]) edges.unary(new EdgeAttitude(f), f.node, false);
  for (std::size_t k = 0; k < graph.positions.size(); ++k)
    if (const auto& f = graph.positions[k]; !problem.held[f.node])
      edges.unary(new EdgePosition(f, weights.positions[k]), f.node, f.robust);
}

std::vector<SE3> poses(const g2o::SparseOptimizer& optimizer, const std::vector<SE3>& start) {
  std::vector<SE3> out = start;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto* vertex = static_cast<const g2o::VertexSE3*>(optimizer.vertex(int(i)));
    if (!vertex->fixed()) out[i] = from_isometry(vertex->estimate());
  }
  return out;
}

}  // namespace cambium::g2o_solver
