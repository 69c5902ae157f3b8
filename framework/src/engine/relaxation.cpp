// SPDX-License-Identifier: BSD-3-Clause
#include "engine/relaxation.hpp"

#include <fmt/format.h>

#include <map>
#include <numbers>

#include "engine/frames.hpp"
#include "engine/gravity.hpp"
#include "engine/keys.hpp"

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

}  // namespace

std::vector<IslandGraph> relaxation_graphs(Atlas& atlas, const StepKeys& keys,
                                           const std::function<void(const std::string&)>& warn) {
  atlas = join_islands(std::move(atlas), warn);
  const double sigma = keys.attitude_sigma * std::numbers::pi / 180;
  std::vector<IslandGraph> graphs;
  for (std::uint32_t i = 0; i < atlas.islands.size(); ++i) {
    const auto tilted = not_level(atlas, i, max_tilt, warn);
    graphs.push_back(build_graph(atlas, i, sigma, tilted, warn));
  }
  return graphs;
}

Solution relax(const IslandGraph& island, const StepScope& scope, Making& making) {
  const Configured& c = scope.step.configured;
  const PoseGraph& g = island.graph;
  Solution solution = scope.cached<Solution>(c, graph_key(g), making, [&](const Context& context) {
    return c.as<Solver>().solve(g, context);
  });
  check(solution, g, scope.step);
  return solution;
}

void place(const Solution& s, const IslandGraph& island, Atlas& atlas) {
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

}  // namespace cambium
