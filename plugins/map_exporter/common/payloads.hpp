// SPDX-License-Identifier: BSD-3-Clause
// One pass over the payloads of a map.
#pragma once
#include <algorithm>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"

namespace cambium::map_export {

/// In the order of missions and nodes.
inline std::vector<NodeRef> nodes_with_payload(const Atlas& atlas,
                                               const std::vector<std::uint32_t>& missions) {
  std::vector<NodeRef> out;
  for (const std::uint32_t m : missions)
    for (std::uint32_t n = 0; n < atlas.missions[m].mission->nodes.size(); ++n)
      if ((*atlas.payloads)[m][n]) out.push_back({m, n});
  return out;
}

/// Calls visit(node, payload) in the order of the nodes; a few payloads at a time load side by
/// side. Each node is a part of the work that the context counts.
template <class Visit>
void for_each_payload(const Atlas& atlas, const std::vector<NodeRef>& nodes, const Context& context,
                      const Visit& visit) {
  context.expect(nodes.size());
  const std::size_t batch = 2 * std::size_t(std::max(1, context.threads()));
  for (std::size_t begin = 0; begin < nodes.size(); begin += batch) {
    context.check_cancelled();
    std::vector<Payload> loaded(std::min(batch, nodes.size() - begin));
    context.parallel_for(loaded.size(),
                         [&](std::size_t k) { loaded[k] = atlas.payload(nodes[begin + k]); });
    for (std::size_t k = 0; k < loaded.size(); ++k) {
      visit(nodes[begin + k], loaded[k]);
      loaded[k] = {};
      context.advance();
    }
  }
}

}  // namespace cambium::map_export
