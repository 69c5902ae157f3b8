// SPDX-License-Identifier: BSD-3-Clause
#include "engine/pair_maps.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "engine/missions.hpp"
#include "engine/relaxation.hpp"

namespace cambium {
namespace {

void silent(const std::string&) {}  // the step that relaxed the map of all has said it

using LoopsOfPairs = std::map<PairOfMissions, std::vector<std::size_t>>;  // into atlas.loops

LoopsOfPairs accepted_loops(const Atlas& atlas) {
  LoopsOfPairs out;
  for (std::size_t i = 0; i < atlas.loops.size(); ++i)
    if (const Loop& loop = atlas.loops[i]; loop.state == LoopState::accepted)
      out[{loop.head.mission, loop.tail.mission}].push_back(i);
  return out;
}

/// The missions of the pair as they were read, with the accepted loops among them.
Atlas alone(const Atlas& atlas, const PairOfMissions& pair, const LoopsOfPairs& accepted) {
  const std::set<std::uint32_t> members{pair.reference, pair.query};
  Atlas out;
  auto payloads = std::make_shared<PayloadSources>();
  std::vector<std::size_t> loops;
  for (const std::uint32_t m : members) {
    const auto index = std::uint32_t(out.missions.size());
    out.missions.push_back(initial_state(atlas.missions[m].mission, index));
    out.islands.push_back({{index}, out.missions.back().mission->georeference});
    payloads->push_back((*atlas.payloads)[m]);
    for (const std::uint32_t other : members)
      if (const auto it = accepted.find({m, other}); it != accepted.end())
        loops.insert(loops.end(), it->second.begin(), it->second.end());
  }
  out.payloads = payloads;
  assign_offsets(out.missions);  // ids are part of a graph, and other missions must not shift them
  std::sort(loops.begin(), loops.end());
  for (const std::size_t i : loops) {
    Loop& loop = out.loops.emplace_back(atlas.loops[i]);
    for (NodeRef* n : {&loop.tail, &loop.head}) n->mission = n->mission == pair.reference ? 0 : 1;
  }
  return out;
}

std::shared_ptr<const Atlas> relaxed(Atlas atlas, const StepScope& scope, Making& making) try {
  const auto graphs = relaxation_graphs(atlas, scope.step.keys, silent);
  if (graphs.size() != 1) return nullptr;
  const Solution solution = relax(graphs.front(), scope, making);
  if (!solution.converged) return nullptr;
  place(solution, graphs.front(), atlas);
  return std::make_shared<const Atlas>(std::move(atlas));
} catch (const Error& e) {
  if (e.code() != ErrorCode::numeric) throw;
  return nullptr;  // loops without heights, say, hold a map together only beside those of others
}

}  // namespace

std::vector<std::shared_ptr<const Atlas>> pair_maps(const Known& known,
                                                    const std::vector<PairOfMissions>& pairs,
                                                    const StepScope& scope) {
  std::vector<std::shared_ptr<const Atlas>> out(pairs.size());
  if (!known.relaxed_by) return out;
  const Atlas& atlas = known.atlas;
  const auto accepted = accepted_loops(atlas);
  std::vector<std::size_t> work;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (accepted.contains(pairs[i]) &&
        atlas.islands[atlas.missions[pairs[i].query].island].positions.empty())
      work.push_back(i);
  const StepScope as_then{*known.relaxed_by, scope.engine, scope.seed, scope.out, scope.record};
  as_then.run_items(work.size(), [&](std::size_t k) {
    Making making;
    out[work[k]] = relaxed(alone(atlas, pairs[work[k]], accepted), as_then, making);
    return making;
  });
  return out;
}

}  // namespace cambium
