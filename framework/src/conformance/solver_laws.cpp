// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <numeric>

#include "conformance/law.hpp"
#include "engine/graph.hpp"

namespace cambium::conformance {
namespace {

Solution solve(const Subject& s, const PoseGraph& graph, const Context& context) {
  Solution x = s.as<Solver>().solve(graph, context);
  require(x.T_map_node.size() == graph.T_map_node.size(),
          fmt::format("{} poses for {} nodes", x.T_map_node.size(), graph.T_map_node.size()));
  for (std::size_t i = 0; i < x.T_map_node.size(); ++i)
    require(x.T_map_node[i].finite(),
            fmt::format("the pose of node {} is not finite", graph.ids[i]));
  require(
      x.weight.empty() || x.weight.size() == graph.relative.size(),
      fmt::format("{} weights for {} relative factors", x.weight.size(), graph.relative.size()));
  for (const double w : x.weight)
    require(w >= 0 && w <= 1, fmt::format("a weight of {}; expected 0 to 1", w));
  const double before = cost(graph, graph.T_map_node), after = cost(graph, x.T_map_node, x.weight);
  require(after <= before * (1 + 1e-9) + 1e-12,
          fmt::format("raised the cost from {:.9g} to {:.9g}", before, after));
  return x;
}

PoseGraph graph_of(const Atlas& atlas) {
  return build_graph(atlas, 0, 0, [](const auto&) {}).graph;
}

void holds_the_gauge(const Subject& s) {
  const Host host(1);
  const PoseGraph graph = graph_of(s.world.atlas);
  const Solution x = solve(s, graph, *host.context());
  for (std::size_t i = 0; i < graph.fixed.size(); ++i) {
    if (!graph.fixed[i]) continue;
    const SE3 moved = graph.T_map_node[i].inverse() * x.T_map_node[i];
    require(moved.t.norm() < 1e-9 && rotation_angle(moved) < 1e-9,
            fmt::format("moved node {}, which is held", graph.ids[i]));
  }
}

void relaxes(const Subject& s) {
  const Host host(1);
  PoseGraph graph = graph_of(s.world.atlas);
  for (std::size_t i = 0; i < graph.T_map_node.size(); ++i)
    if (!graph.fixed[i])
      graph.T_map_node[i] = graph.T_map_node[i] * SE3::from_yaw(0.02, {0.3, -0.2, 0.1});
  const double before = cost(graph, graph.T_map_node);
  const Solution x = solve(s, graph, *host.context());
  const double after = cost(graph, x.T_map_node, x.weight);
  require(after < before / 2,
          fmt::format("of a disturbed graph the cost went from {:.4g} to {:.4g} "
                      "only; does it minimise the cost of pose_graph.hpp?",
                      before, after));
}

PoseGraph one_node() {
  PoseGraph graph;
  graph.T_map_node = {SE3{}};
  graph.ids = {0};
  graph.fixed = {true};
  return graph;
}

}  // namespace

Exercise exercise_solver(const Subject& s) {
  const auto on = [&s](PoseGraph graph) -> Call {
    return [&s, graph = std::move(graph)](const Context& c) { return encode(solve(s, graph, c)); };
  };
  const PoseGraph graph = graph_of(s.world.atlas);
  PoseGraph flat = graph, repeated = graph;
  for (RelativeFactor& f : flat.relative) f.information.bottomRightCorner<3, 3>().setZero();
  repeated.relative.insert(repeated.relative.end(), graph.relative.begin(), graph.relative.end());
  Exercise e;
  e.usual = on(graph);
  e.odd = {{"a graph without nodes", on({})},
           {"one node that is held", on(one_node())},
           {"information that is singular", on(flat)},
           {"every constraint twice", on(repeated)}};
  e.own = {{"leaves held nodes where they are", holds_the_gauge},
           {"lowers the cost of a disturbed graph", relaxes}};
  return e;
}

}  // namespace cambium::conformance
