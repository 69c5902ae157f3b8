// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/string_table.hpp"
#include "map_json.hpp"

namespace web_view {
namespace {

using namespace cambium;

/// Of a registration that converged; a guess is none.
Json transform(const Loop& loop) {
  if (loop.registered_by.empty() || loop.decided_by == loop.registered_by) return nullptr;
  Json out = Json::array();
  for (const double v : loop.T_tail_head.t) out.push_back(rounded(v, 4));
  for (const double v : loop.T_tail_head.q.coeffs()) out.push_back(rounded(v, 7));
  return out;
}

}  // namespace

Json loops_json(const Atlas& atlas) {
  const auto first = first_nodes(atlas);
  StringTable strings;
  Json rows = Json::array();
  for (const Loop& loop : atlas.loops) {
    Json scores = Json::array();  // a name's number, its value, ...
    for (const auto& [name, value] : loop.scores) {
      scores.push_back(strings(name));
      scores.push_back(rounded(value, 4));
    }
    const bool accepted = loop.state == LoopState::accepted;
    rows.push_back({first[loop.tail.mission] + loop.tail.node,
                    first[loop.head.mission] + loop.head.node, strings(to_string(loop.state)),
                    strings(loop.proposed_by), strings(loop.registered_by),
                    strings(loop.decided_by), strings(loop.reason),
                    accepted ? rounded(loop.weight, 3) : Json(nullptr), transform(loop),
                    std::move(scores)});
  }
  return {{"columns", {"tail", "head", "state", "proposed_by", "registered_by", "decided_by",
                       "reason", "weight", "T_tail_head", "scores"}},
          {"strings", strings.list()},
          {"rows", std::move(rows)}};
}

}  // namespace web_view
