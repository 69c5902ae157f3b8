// SPDX-License-Identifier: BSD-3-Clause
#include "common/topology.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "common/short_list.hpp"

namespace cambium::pose_solver {
namespace {

bool same_measurement(const RelativeFactor& a, const RelativeFactor& b) {
  return a.T_tail_head.t == b.T_tail_head.t &&
         a.T_tail_head.q.coeffs() == b.T_tail_head.q.coeffs() && a.information == b.information;
}

/// The factors, those between the same two nodes side by side.
std::vector<std::uint32_t> by_nodes(const std::vector<RelativeFactor>& factors) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(factors.size());
  for (const auto& f : factors)
    keys.emplace_back(std::uint64_t(f.tail) << 32 | f.head, std::uint32_t(keys.size()));
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> out;
  for (const auto& [key, k] : keys) out.push_back(k);
  return out;
}

void warn_of_copies(const PoseGraph& graph, const Context& context) {
  const auto& factors = graph.relative;
  const auto order = by_nodes(factors);
  ShortList copies;
  for (std::size_t first = 0, i = 1; i < order.size(); ++i) {
    const auto& f = factors[order[i]];
    const auto& g = factors[order[first]];
    if (f.tail != g.tail || f.head != g.head) first = i;
    for (std::size_t j = first; j < i; ++j)
      if (same_measurement(factors[order[j]], f)) {
        copies.add(fmt::format("{} is a copy of {}", f.label, factors[order[j]].label));
        break;
      }
  }
  if (copies.count() > 0)
    context.warn(
        fmt::format("{} factors repeat another one to the last digit; each counts, so "
                    "the measurement has the weight of several (keep one):{}",
                    copies.count(), copies.text()));
}

}  // namespace

void warn_of_topology(const PoseGraph& graph, const std::vector<std::size_t>& component,
                      const std::vector<bool>& held, const Context& context) {
  warn_of_copies(graph, context);
  if (std::all_of(component.begin(), component.end(), [](auto c) { return c == 0; })) return;
  std::vector<std::size_t> nodes(component.size());
  for (const std::size_t c : component) ++nodes[c];
  ShortList loose;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i] && !graph.fixed[i])
      loose.add(fmt::format("node {} and the {} tied to it",
                            i < graph.ids.size() ? graph.ids[i] : NodeId(i),
                            nodes[component[i]] - 1));
  if (loose.count() > 0)
    context.warn(
        fmt::format("{} parts of the graph are tied to nothing; each keeps its first node "
                    "where it was given:{}",
                    loose.count(), loose.text()));
}

}  // namespace cambium::pose_solver
