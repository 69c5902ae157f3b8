// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <map>

#include "engine/keys.hpp"
#include "engine/pair_maps.hpp"
#include "engine/rounded.hpp"

namespace cambium {
namespace {

const Configured& registration_for(const Step& step, const Atlas& atlas, const Loop& loop) {
  return step.for_pair(atlas.mission(loop.tail).platform_id, atlas.mission(loop.head).platform_id);
}

bool in_one_island(const Atlas& atlas, const Loop& loop) {
  return atlas.missions[loop.tail.mission].island == atlas.missions[loop.head.mission].island;
}

/// Where a map of their own has the nodes of a loop, else that of all.
SE3 on_the_map(const Atlas& atlas, const std::shared_ptr<const Atlas>& own, const Loop& loop) {
  if (!own) return atlas.T_map_node(loop.tail).inverse() * atlas.T_map_node(loop.head);
  const auto last = std::uint32_t(own->missions.size() - 1);
  return own->T_map_node({0, loop.tail.node}).inverse() * own->T_map_node({last, loop.head.node});
}

bool by_recognizer(const Loop& loop) {
  return loop.has_guess && loop.state == LoopState::candidate;
}

/// First guesses: the recogniser's, else what the map says, else that both nodes stood in the same
/// place. Of an accepted loop the map knows more than the recogniser did; it is not rounded,
/// because what a registration cannot see (heights of stems) stays as the guess has it.
std::vector<SE3> guesses(const Known& known, const std::vector<std::size_t>& work,
                         const StepScope& scope) {
  const Atlas& atlas = known.atlas;
  std::map<PairOfMissions, std::shared_ptr<const Atlas>> own;
  for (const std::size_t i : work)
    if (const Loop& loop = atlas.loops[i]; !by_recognizer(loop) && in_one_island(atlas, loop))
      own[{loop.head.mission, loop.tail.mission}] = nullptr;
  std::vector<PairOfMissions> pairs;
  for (const auto& [pair, none] : own) pairs.push_back(pair);
  const auto maps = pair_maps(known, pairs, scope);
  for (std::size_t k = 0; k < pairs.size(); ++k) own[pairs[k]] = maps[k];

  std::vector<SE3> out;
  for (const std::size_t i : work) {
    const Loop& loop = atlas.loops[i];
    const auto it = own.find({loop.head.mission, loop.tail.mission});
    if (by_recognizer(loop))
      out.push_back(loop.T_tail_head);
    else if (it == own.end())
      out.push_back(SE3{});
    else if (const SE3 T = on_the_map(atlas, it->second, loop); loop.state == LoopState::accepted)
      out.push_back(T);
    else
      out.push_back(rounded(T));
  }
  return out;
}

// Search trees, normals and the like are computed once per payload and kept beside it.
std::shared_ptr<const Prepared> prepare(const Configured& c, const Atlas& atlas, NodeRef node,
                                        const StepScope& scope) {
  const Digest key = Hasher().add("prepared").add(c.key).add(payload_key(atlas, node)).digest();
  const auto value = scope.engine.store()->get(key, [&] {
    const auto context = scope.engine.context(key, scope.seed);
    auto prepared = std::make_shared<const Prepared>(
        c.as<Registration>().prepare(atlas.payload(node), *context));
    return MemoryStore::Value{prepared, prepared->bytes + prepared->payload.bytes()};
  });
  return std::static_pointer_cast<const Prepared>(value);
}

Alignment align(const Atlas& atlas, const Loop& loop, const SE3& T_guess, const StepScope& scope,
                Making& making) {
  const Configured& c = registration_for(scope.step, atlas, loop);
  const Digest input = Hasher()
                           .add(payload_key(atlas, loop.tail))
                           .add(payload_key(atlas, loop.head))
                           .add(encode(T_guess))
                           .digest();
  return scope.cached<Alignment>(c, input, making, [&](const Context& context) {
    const auto target = prepare(c, atlas, loop.tail, scope);
    const auto source = prepare(c, atlas, loop.head, scope);
    return c.as<Registration>().align(*target, *source, T_guess, context);
  });
}

void put_scores(const std::vector<Score>& scores, Loop& loop) {
  for (const auto& [name, value] : scores) {
    std::erase_if(loop.scores, [&](const auto& old) { return old.first == name; });
    loop.scores.emplace_back(name, value);
  }
}

void apply(const Alignment& a, const Step& step, Loop& loop) {
  put_scores(a.scores, loop);
  loop.registered_by = step.plugin;
  const bool sound = a.T_target_source.finite() && a.information.allFinite();
  if (a.converged && sound) {
    if (loop.state == LoopState::candidate) loop.state = LoopState::registered;
    loop.T_tail_head = a.T_target_source;
    loop.information = a.information;
    return;
  }
  loop.state = LoopState::rejected;
  loop.decided_by = step.plugin;
  loop.reason = !sound ? "the registration returned numbers that are not finite"
                       : (a.reason.empty() ? "did not converge" : a.reason);
}

}  // namespace

Known run_register(Known known, const StepScope& scope) {
  auto& loops = known.atlas.loops;
  const bool again = scope.step.keys.loops == "accepted";
  const LoopState wanted = again ? LoopState::accepted : LoopState::candidate;
  std::vector<std::size_t> work;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].state == wanted) work.push_back(i);
  const auto guessed = guesses(known, work, scope);
  std::vector<Alignment> alignments(work.size());
  scope.run_items(work.size(), [&](std::size_t i) {
    Making making;
    alignments[i] = align(known.atlas, loops[work[i]], guessed[i], scope, making);
    return making;
  });
  std::size_t converged = 0;
  for (std::size_t i = 0; i < work.size(); ++i) {
    apply(alignments[i], scope.step, loops[work[i]]);
    converged += loops[work[i]].state != LoopState::rejected;
  }
  scope.record.summary = fmt::format("{} of {} {} converged", converged, work.size(),
                                     again ? "accepted loops" : "candidates");
  return known;
}

}  // namespace cambium
