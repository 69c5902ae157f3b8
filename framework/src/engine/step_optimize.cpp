// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <numbers>

#include "engine/frames.hpp"
#include "engine/graph.hpp"
#include "engine/gravity.hpp"
#include "engine/keys.hpp"
#include "engine/marginals.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

// Lidar-inertial odometry is level to a degree; a frame of another kind is off by a right angle.
constexpr double max_tilt = 5 * std::numbers::pi / 180;

Digest graph_key(const PoseGraph& g) {
  Encoder e;
  e(g.T_map_node, g.ids);
  for (const bool fixed : g.fixed) e(fixed);
  for (const auto& f : g.relative)
    e(std::uint64_t(f.tail), std::uint64_t(f.head), f.T_tail_head, f.information, f.robust);
  for (const auto& f : g.attitude) e(std::uint64_t(f.node), f.up_node, f.sigma);
  for (const auto& f : g.priors) e(std::uint64_t(f.node), f.T_map_node, f.information);
  for (const auto& f : g.positions) e(std::uint64_t(f.node), f.t_map, f.information, f.robust);
  for (const std::size_t node : g.marginals) e(std::uint64_t(node));
  return digest_bytes(e.bytes);
}

void check(const Solution& s, const PoseGraph& g, const Step& step) {
  bool sound = s.T_map_node.size() == g.T_map_node.size() && s.weight.size() == g.relative.size();
  for (const SE3& T : s.T_map_node) sound = sound && T.finite();
  if (!sound)
    throw Error(
        ErrorCode::numeric, step.registered->library,
        fmt::format("'{}' returned {} poses and {} weights (finite: {}) for {} nodes and {} "
                    "relative factors",
                    step.plugin, s.T_map_node.size(), s.weight.size(), sound, g.T_map_node.size(),
                    g.relative.size()));
}

void apply(const Solution& s, const IslandGraph& island, Atlas& atlas) {
  std::map<std::uint32_t, std::vector<SE3>> poses;
  for (std::size_t i = 0; i < island.nodes.size(); ++i)
    poses[island.nodes[i].mission].push_back(s.T_map_node[i]);
  for (auto& [m, p] : poses)
    atlas.missions[m].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(p));
  const auto& relative = island.graph.relative;
  const std::size_t first_loop = relative.size() - island.loops.size();
  for (std::size_t k = 0; k < island.loops.size(); ++k) {
    const RelativeFactor& f = relative[first_loop + k];
    Loop& loop = atlas.loops[island.loops[k]];
    loop.weight = s.weight[first_loop + k];
    loop.residual = residual(f.T_tail_head, s.T_map_node[f.tail], s.T_map_node[f.head]);
  }
}

}  // namespace

Known run_optimize(Known known, const StepScope& scope) {
  Atlas& atlas = known.atlas;
  atlas = join_islands(std::move(atlas));
  const auto warn = [&](const std::string& text) {
    scope.engine.progress().log(LogLevel::warning, text);
  };
  const double sigma = scope.step.keys.attitude_sigma * std::numbers::pi / 180;
  std::vector<IslandGraph> graphs;
  for (std::uint32_t i = 0; i < atlas.islands.size(); ++i) {
    const auto tilted = not_level(atlas, atlas.islands[i], max_tilt, warn);
    graphs.push_back(build_graph(atlas, i, sigma, tilted, warn));
  }
  ask_for_marginals(atlas, scope.step.keys.marginals, graphs);

  std::vector<Solution> solutions(graphs.size());
  const Configured& c = scope.step.configured;
  scope.run_items(graphs.size(), [&](std::size_t i) {
    Making making;
    const PoseGraph& g = graphs[i].graph;
    solutions[i] = scope.cached<Solution>(c, graph_key(g), making, [&](const Context& context) {
      return c.as<Solver>().solve(g, context);
    });
    check(solutions[i], g, scope.step);
    return making;
  });

  double before = 0, after = 0;
  for (std::size_t i = 0; i < graphs.size(); ++i) {
    before += cost(graphs[i].graph, graphs[i].graph.T_map_node);
    after += cost(graphs[i].graph, solutions[i].T_map_node, solutions[i].weight);
    scope.record.figures.emplace_back(fmt::format("island_{}.iterations", i),
                                      solutions[i].iterations);
    for (const auto& [name, value] : solutions[i].scores)
      scope.record.figures.emplace_back(fmt::format("island_{}.{}", i, name), value);
    for (auto& figure : marginal_figures(atlas, graphs[i], solutions[i]))
      scope.record.figures.push_back(std::move(figure));
    if (!solutions[i].converged)
      warn(fmt::format("island {}: the solver did not converge: {}", i, solutions[i].message));
    apply(solutions[i], graphs[i], atlas);
  }
  scope.record.figures.emplace_back("cost.before", before);
  scope.record.figures.emplace_back("cost.after", after);
  scope.record.summary =
      fmt::format("{} island(s), F {:.6g} -> {:.6g}", graphs.size(), before, after);
  return known;
}

}  // namespace cambium
