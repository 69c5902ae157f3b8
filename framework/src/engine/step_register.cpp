// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

const Configured& registration_for(const Step& step, const Atlas& atlas, const Loop& loop) {
  return step.for_pair(atlas.mission(loop.tail).platform_id, atlas.mission(loop.head).platform_id);
}

// The recogniser's guess, else what the map says, else that both nodes stood in the same place.
SE3 guess(const Atlas& atlas, const Loop& loop) {
  if (loop.has_guess) return loop.T_tail_head;
  if (atlas.missions[loop.tail.mission].island == atlas.missions[loop.head.mission].island)
    return atlas.T_map_node(loop.tail).inverse() * atlas.T_map_node(loop.head);
  return {};
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

Alignment align(const Atlas& atlas, const Loop& loop, const StepScope& scope, Making& making) {
  const Configured& c = registration_for(scope.step, atlas, loop);
  const SE3 T_guess = guess(atlas, loop);
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

void apply(const Alignment& a, const Step& step, Loop& loop) {
  loop.scores.insert(loop.scores.end(), a.scores.begin(), a.scores.end());
  loop.registered_by = step.plugin;
  const bool sound = a.T_target_source.finite() && a.information.allFinite();
  if (a.converged && sound) {
    loop.state = LoopState::registered;
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
  std::vector<std::size_t> work;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].state == LoopState::candidate) work.push_back(i);
  std::vector<Alignment> alignments(work.size());
  scope.run_items(work.size(), [&](std::size_t i) {
    Making making;
    alignments[i] = align(known.atlas, loops[work[i]], scope, making);
    return making;
  });
  std::size_t converged = 0;
  for (std::size_t i = 0; i < work.size(); ++i) {
    apply(alignments[i], scope.step, loops[work[i]]);
    converged += loops[work[i]].state == LoopState::registered;
  }
  scope.record.summary = fmt::format("{} of {} candidates converged", converged, work.size());
  return known;
}

}  // namespace cambium
