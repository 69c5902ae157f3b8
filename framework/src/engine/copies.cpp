// SPDX-License-Identifier: BSD-3-Clause
#include "engine/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "cambium/error.hpp"

namespace cambium {
namespace {

/// What a node says of itself, without its id: copies may be numbered anew.
Digest node_digest(const Node& node) {
  Hasher hasher;
  hasher.add(std::uint64_t(node.stamp.has_value()));
  if (node.stamp) hasher.add(std::uint64_t(node.stamp->sec)).add(std::uint64_t(node.stamp->nsec));
  for (int i = 0; i < 3; ++i) hasher.add(node.T_mission_node.t[i]);
  for (int i = 0; i < 4; ++i) hasher.add(node.T_mission_node.q.coeffs()[i]);
  return hasher.digest();
}

std::vector<Digest> node_digests(const Mission& mission) {
  std::vector<Digest> out;
  for (const Node& node : mission.nodes) out.push_back(node_digest(node));
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

void refuse_copies(const std::vector<Mission>& missions) {
  std::vector<std::vector<Digest>> nodes;
  for (const Mission& m : missions) nodes.push_back(node_digests(m));
  for (std::size_t b = 0; b < missions.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      std::vector<Digest> common;
      std::set_intersection(nodes[a].begin(), nodes[a].end(), nodes[b].begin(), nodes[b].end(),
                            std::back_inserter(common));
      if (common.size() < 2 || 2 * common.size() <= std::min(nodes[a].size(), nodes[b].size()))
        continue;
      throw Error(
          ErrorCode::data, missions[b].graph_file.string(),
          fmt::format("the missions '{}' and '{}' are the same recording: {} of their nodes "
                      "have the same stamp and the same pose; leave one of them out ({})",
                      missions[a].name, missions[b].name, common.size(),
                      missions[a].graph_file.string()));
    }
}

}  // namespace cambium
