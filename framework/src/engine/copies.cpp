// SPDX-License-Identifier: BSD-3-Clause
#include "engine/copies.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "cambium/atlas.hpp"
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

/// Of each mission: the different digests that it has.
using Contents = std::vector<std::vector<Digest>>;

struct Common {
  std::size_t a, b, count;  ///< missions, and how many digests both have
};

/// The first two missions that share more than half of what one of them has. One pass over all
/// digests in order: comparing each mission with each would grow with their square.
std::optional<Common> first_copy(Contents& contents) {
  std::vector<std::pair<Digest, std::size_t>> all;
  for (std::size_t m = 0; m < contents.size(); ++m) {
    auto& own = contents[m];
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    for (const Digest& d : own) all.emplace_back(d, m);
  }
  std::sort(all.begin(), all.end());
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> common;  // (b, a), a < b
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size() && all[j].first == all[i].first; ++j)
      ++common[{all[j].second, all[i].second}];
  for (const auto& [pair, count] : common) {
    const auto [b, a] = pair;
    if (count >= 2 && 2 * count > std::min(contents[a].size(), contents[b].size()))
      return Common{a, b, count};
  }
  return std::nullopt;
}

[[noreturn]] void refuse(const Mission& a, const Mission& b, const std::string& what) {
  throw Error(ErrorCode::data, b.graph_file.string(),
              fmt::format("the missions '{}' and '{}' are the same recording: {}; leave one of "
                          "them out ({})",
                          a.name, b.name, what, a.graph_file.string()));
}

}  // namespace

void refuse_copies(const std::vector<Mission>& missions) {
  Contents contents(missions.size());
  for (std::size_t m = 0; m < missions.size(); ++m)
    for (const Node& node : missions[m].nodes) contents[m].push_back(node_digest(node));
  if (const auto copy = first_copy(contents))
    refuse(missions[copy->a], missions[copy->b],
           fmt::format("{} of their nodes have the same stamp and the same pose", copy->count));
}

void refuse_shared_payloads(const Atlas& atlas, const Engine& engine) {
  std::vector<std::pair<std::size_t, const PayloadSource*>> sources;
  for (std::size_t m = 0; m < atlas.missions.size(); ++m)
    for (const auto& source : (*atlas.payloads)[m])
      if (source) sources.emplace_back(m, source.get());
  std::vector<Digest> digests(sources.size());
  engine.parallel_for(sources.size(),
                      [&](std::size_t i) { digests[i] = sources[i].second->digest(); });
  Contents contents(atlas.missions.size());
  for (std::size_t i = 0; i < sources.size(); ++i) contents[sources[i].first].push_back(digests[i]);
  if (const auto copy = first_copy(contents))
    refuse(*atlas.missions[copy->a].mission, *atlas.missions[copy->b].mission,
           fmt::format("{} of their payloads are the same to the last byte, whatever their pose "
                       "graphs say",
                       copy->count));
}

}  // namespace cambium
