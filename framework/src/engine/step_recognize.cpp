// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cambium/path.hpp"
#include "engine/keys.hpp"
#include "engine/mission_pairs.hpp"
#include "engine/pair_maps.hpp"
#include "engine/rounded.hpp"

namespace cambium {
namespace {

struct Described {
  Fingerprints fingerprints;
  Digest digest;
};

Digest describe_input(const Atlas& atlas, std::uint32_t m, bool poses) {
  Hasher hasher;
  hasher.add("describe").add(atlas.missions[m].mission->digest).add(payloads_key(atlas, m));
  if (poses)
    hasher.add(poses_key(*atlas.missions[m].T_map_node))
        .add(std::uint64_t(atlas.missions[m].island));
  return hasher.digest();
}

Described describe(const Atlas& atlas, std::uint32_t m, const StepScope& scope, Making& making) {
  const MissionView view{atlas, m};
  const Configured& c = scope.step.for_platform(view.mission().platform_id);
  const auto& recognizer = c.as<PlaceRecognizer>();
  Described out;
  out.fingerprints = scope.cached<Fingerprints>(
      c, describe_input(atlas, m, recognizer.uses_poses()), making,
      [&](const Context& context) { return recognizer.describe(view, context); });
  out.digest = digest_bytes(encode(out.fingerprints));
  return out;
}

std::vector<Candidate> match(const Atlas& atlas, const PairOfMissions& pair,
                             const std::vector<Described>& described, const StepScope& scope,
                             Making& making) {
  const Mission& query = *atlas.missions[pair.query].mission;
  const Mission& reference = *atlas.missions[pair.reference].mission;
  const Pairing pairing{pair.query == pair.reference, scope.step.keys.min_path, travelled(query),
                        travelled(reference)};
  const Configured& c = scope.step.for_pair(reference.platform_id, query.platform_id);
  const Digest input = Hasher()
                           .add("match")
                           .add(described[pair.query].digest)
                           .add(described[pair.reference].digest)
                           .add(encode(pairing.query_path))
                           .add(encode(pairing.reference_path))
                           .add(std::uint64_t(pairing.within_mission))
                           .add(pairing.min_path)
                           .digest();
  return scope.cached<std::vector<Candidate>>(c, input, making, [&](const Context& context) {
    return c.as<PlaceRecognizer>().match(described[pair.query].fingerprints,
                                         described[pair.reference].fingerprints, pairing, context);
  });
}

Loop to_loop(const Candidate& c, const PairOfMissions& pair, const std::string& plugin,
             bool from_map) {
  Loop loop;
  loop.tail = {pair.reference, std::uint32_t(c.reference)};
  loop.head = {pair.query, std::uint32_t(c.query)};
  loop.has_guess = c.T_reference_query.has_value();
  if (loop.has_guess)
    loop.T_tail_head = from_map ? rounded(*c.T_reference_query) : *c.T_reference_query;
  loop.scores = {{plugin, c.score}};
  loop.proposed_by = plugin;
  if (loop.head < loop.tail) {  // a recogniser may propose an earlier node as the query
    std::swap(loop.tail, loop.head);
    loop.T_tail_head = loop.T_tail_head.inverse();
  }
  return loop;
}

void check(const Candidate& c, const PairOfMissions& pair, const Atlas& atlas, const Step& step) {
  const std::size_t queries = atlas.missions[pair.query].mission->nodes.size();
  const std::size_t references = atlas.missions[pair.reference].mission->nodes.size();
  const bool self = pair.query == pair.reference && c.query == c.reference;
  if (c.query < queries && c.reference < references && !self &&
      (!c.T_reference_query || c.T_reference_query->finite()))
    return;
  throw Error(ErrorCode::plugin, step.registered->library,
              fmt::format("'{}' proposed the pair (query {}, reference {}) of missions with {} and "
                          "{} nodes; expected two different nodes and a finite guess",
                          step.plugin, c.query, c.reference, queries, references));
}

// A pair that is accepted already stays as it is. One that was tried in vain gets another chance.
std::size_t add_loops(std::vector<Loop>& loops, std::vector<Loop> found) {
  const auto by_nodes = [](const Loop& a, const Loop& b) {
    return std::tie(a.tail, a.head) < std::tie(b.tail, b.head);
  };
  std::stable_sort(found.begin(), found.end(), by_nodes);
  std::vector<Loop> out;
  std::size_t added = 0, at = 0;
  for (auto& loop : found) {
    while (at < loops.size() && by_nodes(loops[at], loop)) out.push_back(std::move(loops[at++]));
    const bool known = at < loops.size() && !by_nodes(loop, loops[at]);
    const bool twice = !out.empty() && !by_nodes(out.back(), loop);
    if (twice || (known && loops[at].state == LoopState::accepted)) continue;
    if (known) ++at;
    out.push_back(std::move(loop));
    ++added;
  }
  while (at < loops.size()) out.push_back(std::move(loops[at++]));
  loops = std::move(out);
  return added;
}

using Found = std::vector<std::vector<Candidate>>;  // for each pair

/// The candidates of the pairs that have no `own` map, from the atlas.
void search(const Atlas& atlas, const std::vector<MissionPair>& pairs,
            const std::vector<std::shared_ptr<const Atlas>>& own, const StepScope& scope,
            Found& found) {
  std::vector<std::size_t> work;
  std::set<std::uint32_t> occurring;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (own[i]) continue;
    work.push_back(i);
    occurring.insert({pairs[i].missions.query, pairs[i].missions.reference});
  }
  const std::vector<std::uint32_t> missions(occurring.begin(), occurring.end());
  std::vector<Described> described(atlas.missions.size());
  scope.run_items(missions.size(), [&](std::size_t i) {
    Making making;
    described[missions[i]] = describe(atlas, missions[i], scope, making);
    return making;
  });
  scope.run_items(work.size(), [&](std::size_t k) {
    Making making;
    found[work[k]] = match(atlas, pairs[work[k]].missions, described, scope, making);
    return making;
  });
}

/// Those of the others, each from its own map; descriptions that use poses serve one pair only.
void search_alone(const std::vector<std::shared_ptr<const Atlas>>& own, const StepScope& scope,
                  Found& found) {
  std::vector<std::size_t> work;
  for (std::size_t i = 0; i < own.size(); ++i)
    if (own[i]) work.push_back(i);
  scope.run_items(work.size(), [&](std::size_t k) {
    const Atlas& atlas = *own[work[k]];
    std::vector<Making> describing(atlas.missions.size());
    std::vector<Described> described;
    for (std::uint32_t m = 0; m < describing.size(); ++m)
      described.push_back(describe(atlas, m, scope, describing[m]));
    Making making;
    const PairOfMissions pair{std::uint32_t(described.size() - 1), 0};
    found[work[k]] = match(atlas, pair, described, scope, making);
    for (const Making& m : describing) making.seconds += m.seconds;
    return making;
  });
}

}  // namespace

Known run_recognize(Known known, const StepScope& scope) {
  const Atlas& atlas = known.atlas;
  const auto all = mission_pairs(atlas.missions.size(), scope.step.keys.pairs);
  auto pairs = that_may_meet(all, atlas, scope);
  const std::size_t apart = all.size() - pairs.size();
  if (scope.share) pairs = shared(std::move(pairs), *scope.share, atlas);
  const bool from_map = scope.step.configured.as<PlaceRecognizer>().uses_poses();
  std::vector<PairOfMissions> missions;
  for (const MissionPair& pair : pairs) missions.push_back(pair.missions);
  const auto own = from_map ? pair_maps(known, missions, scope)
                            : std::vector<std::shared_ptr<const Atlas>>(pairs.size());
  Found found(pairs.size());
  search(atlas, pairs, own, scope, found);
  search_alone(own, scope, found);
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t k = 0; k < found[i].size(); ++k) {
      check(found[i][k], missions[i], atlas, scope.step);
      if (pairs[i].takes(k))
        loops.push_back(to_loop(found[i][k], missions[i], scope.step.plugin, from_map));
    }
  const std::size_t proposed = loops.size(), added = add_loops(known.atlas.loops, std::move(loops));
  scope.record.summary = fmt::format("{} candidates, {} of them new", proposed, added);
  if (apart > 0)
    scope.record.summary +=
        fmt::format("; {} of {} pairs of missions are too far apart to meet", apart, all.size());
  return known;
}

}  // namespace cambium
