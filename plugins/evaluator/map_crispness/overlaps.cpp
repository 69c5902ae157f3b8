// SPDX-License-Identifier: BSD-3-Clause
#include "overlaps.hpp"

namespace map_crispness {
namespace {

using namespace cambium;

/// A node with what decides whether it is close to another.
struct Place {
  NodeRef node;
  std::uint32_t island;
  double path;  // distance travelled [m]
};

std::vector<Place> places(const Atlas& atlas) {
  std::vector<Place> out;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    const auto& nodes = atlas.missions[m].mission->nodes;
    double path = 0;
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      if (n > 0) path += (nodes[n].T_mission_node.t - nodes[n - 1].T_mission_node.t).norm();
      if ((*atlas.payloads)[m][n]) out.push_back({{m, n}, atlas.missions[m].island, path});
    }
  }
  return out;
}

double distance(const Atlas& atlas, const Truth& truth, NodeRef a, NodeRef b) {
  const auto &T_world_a = truth.at(a), &T_world_b = truth.at(b);
  if (T_world_a && T_world_b) return (T_world_a->t - T_world_b->t).norm();
  return (atlas.T_map_node(a).t - atlas.T_map_node(b).t).norm();
}

}  // namespace

std::vector<std::pair<NodeRef, NodeRef>> overlapping_pairs(const Atlas& atlas, const Truth& truth,
                                                           const Limits& limits,
                                                           const Context& context) {
  const auto all = places(atlas);
  std::vector<std::pair<NodeRef, NodeRef>> pairs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    context.check_cancelled();
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      if (all[i].island != all[j].island) continue;
      if (all[i].node.mission == all[j].node.mission && all[j].path - all[i].path < limits.min_path)
        continue;
      if (distance(atlas, truth, all[i].node, all[j].node) <= limits.max_distance)
        pairs.emplace_back(all[i].node, all[j].node);
    }
  }
  if (pairs.size() <= limits.max_pairs) return pairs;
  std::vector<std::pair<NodeRef, NodeRef>> thinned;
  for (std::size_t k = 0; k < limits.max_pairs; ++k)
    thinned.push_back(pairs[k * pairs.size() / limits.max_pairs]);
  return thinned;
}

}  // namespace map_crispness
