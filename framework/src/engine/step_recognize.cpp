// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "cambium/path.hpp"
#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

struct Described {
  Fingerprints fingerprints;
  Digest digest;
};

struct MissionPair {
  std::uint32_t query, reference;
  std::vector<std::size_t> slices = {0};  // of the candidates, those to go on with
  std::size_t of = 1;
};

std::vector<MissionPair> mission_pairs(std::size_t count, const std::string& which) {
  std::vector<MissionPair> pairs;
  for (std::uint32_t query = 0; query < count; ++query)
    for (std::uint32_t reference = 0; reference <= query; ++reference)
      if (which == "all" || (query == reference) == (which == "within_missions"))
        pairs.push_back({query, reference, {0}, 1});
  return pairs;
}

// Of the pairs those that the share names, each with its slices.
std::vector<MissionPair> shared(std::vector<MissionPair> pairs, const Share& share,
                                const Atlas& atlas) {
  const auto name = [&](std::uint32_t m) { return atlas.missions[m].mission->name; };
  for (MissionPair& pair : pairs) {
    pair.slices.clear();
    for (const SharePart& part : share.parts) {
      if (part.query != name(pair.query) || part.reference != name(pair.reference)) continue;
      pair.slices.push_back(part.slice);
      pair.of = part.slices;
    }
  }
  std::erase_if(pairs, [](const MissionPair& pair) { return pair.slices.empty(); });
  return pairs;
}

Digest describe_input(const Atlas& atlas, std::uint32_t m, bool poses) {
  Hasher hasher;
  hasher.add("describe").add(atlas.missions[m].mission->digest).add(payloads_key(atlas, m));
  if (poses)
    hasher.add(poses_key(*atlas.missions[m].T_map_node))
        .add(std::uint64_t(atlas.missions[m].island));
  return hasher.digest();
}

// The missions that occur in the pairs.
std::vector<Described> describe(const Atlas& atlas, const std::vector<MissionPair>& pairs,
                                const StepScope& scope) {
  std::set<std::size_t> needed;
  for (const MissionPair& pair : pairs) needed.insert({pair.query, pair.reference});
  const std::vector<std::size_t> work(needed.begin(), needed.end());
  std::vector<Described> out(atlas.missions.size());
  scope.run_items(work.size(), [&](std::size_t i) {
    const std::size_t m = work[i];
    const MissionView view{atlas, std::uint32_t(m)};
    const Configured& c = scope.step.for_platform(view.mission().platform_id);
    const auto& recognizer = c.as<PlaceRecognizer>();
    Making making;
    out[m].fingerprints = scope.cached<Fingerprints>(
        c, describe_input(atlas, std::uint32_t(m), recognizer.uses_poses()), making,
        [&](const Context& context) { return recognizer.describe(view, context); });
    out[m].digest = digest_bytes(encode(out[m].fingerprints));
    return making;
  });
  return out;
}

std::vector<Candidate> match(const Atlas& atlas, const MissionPair& pair,
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

Loop to_loop(const Candidate& c, const MissionPair& pair, const std::string& plugin) {
  Loop loop;
  loop.tail = {pair.reference, std::uint32_t(c.reference)};
  loop.head = {pair.query, std::uint32_t(c.query)};
  loop.has_guess = c.T_reference_query.has_value();
  if (loop.has_guess) loop.T_tail_head = *c.T_reference_query;
  loop.scores = {{plugin, c.score}};
  loop.proposed_by = plugin;
  if (loop.head < loop.tail) {  // a recogniser may propose an earlier node as the query
    std::swap(loop.tail, loop.head);
    loop.T_tail_head = loop.T_tail_head.inverse();
  }
  return loop;
}

void check(const Candidate& c, const MissionPair& pair, const Atlas& atlas, const Step& step) {
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

}  // namespace

Known run_recognize(Known known, const StepScope& scope) {
  const Atlas& atlas = known.atlas;
  auto pairs = mission_pairs(atlas.missions.size(), scope.step.keys.pairs);
  if (scope.share) pairs = shared(std::move(pairs), *scope.share, atlas);
  const auto described = describe(atlas, pairs, scope);
  std::vector<std::vector<Candidate>> found(pairs.size());
  scope.run_items(pairs.size(), [&](std::size_t i) {
    Making making;
    found[i] = match(atlas, pairs[i], described, scope, making);
    return making;
  });
  std::vector<Loop> loops;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    for (std::size_t k = 0; k < found[i].size(); ++k) {
      check(found[i][k], pairs[i], atlas, scope.step);
      const auto& slices = pairs[i].slices;
      if (std::find(slices.begin(), slices.end(), k % pairs[i].of) != slices.end())
        loops.push_back(to_loop(found[i][k], pairs[i], scope.step.plugin));
    }
  const std::size_t proposed = loops.size(), added = add_loops(known.atlas.loops, std::move(loops));
  scope.record.summary = fmt::format("{} candidates, {} of them new", proposed, added);
  return known;
}

}  // namespace cambium
