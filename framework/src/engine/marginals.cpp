// SPDX-License-Identifier: BSD-3-Clause
#include "engine/marginals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cambium/error.hpp"
#include "pipeline/diagnostics.hpp"

namespace cambium {
namespace {

NodeRef find_node(const Atlas& atlas, const std::string& name) {
  const std::size_t slash = name.rfind('/');
  const std::string mission = name.substr(0, slash);
  NodeId id = -1;
  if (slash != std::string::npos)
    std::from_chars(name.data() + slash + 1, name.data() + name.size(), id);
  std::vector<std::string> known;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    known.push_back(atlas.missions[m].mission->name);
    if (known.back() != mission) continue;
    if (const auto index = atlas.missions[m].mission->index_of(id))
      return {m, std::uint32_t(*index)};
    throw Error(
        ErrorCode::config, "optimize.marginals",
        fmt::format("'{}': expected MISSION/ID, found no node {} in '{}'", name, id, mission));
  }
  throw Error(ErrorCode::config, "optimize.marginals",
              fmt::format("'{}': expected MISSION/ID, found no mission '{}'{}", name, mission,
                          suggestion(mission, known)));
}

}  // namespace

void ask_for_marginals(const Atlas& atlas, const std::vector<std::string>& names,
                       std::vector<IslandGraph>& graphs) {
  for (const std::string& name : names) {
    const NodeRef node = find_node(atlas, name);
    for (IslandGraph& g : graphs) {
      const auto at = std::find(g.nodes.begin(), g.nodes.end(), node);
      if (at != g.nodes.end()) g.graph.marginals.push_back(std::size_t(at - g.nodes.begin()));
    }
  }
}

std::vector<Score> marginal_figures(const Atlas& atlas, const IslandGraph& island,
                                    const Solution& solution) {
  static constexpr const char* axes[] = {"x", "y", "z", "roll", "pitch", "yaw"};
  std::vector<Score> out;
  for (std::size_t k = 0; k < solution.marginals.size(); ++k) {
    const NodeRef node = island.nodes[island.graph.marginals[k]];
    for (int a = 0; a < 6; ++a)
      out.emplace_back(
          fmt::format("{}/{}.sigma_{}", atlas.mission(node).name, atlas.node(node).id, axes[a]),
          std::sqrt(solution.marginals[k](a, a)));
  }
  return out;
}

}  // namespace cambium
