// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {

Known run_verify(Known known, const StepScope& scope) {
  auto& loops = known.atlas.loops;
  std::vector<std::size_t> work;  // loops accepted earlier are judged again beside the new ones
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (loops[i].state == LoopState::registered || loops[i].state == LoopState::accepted)
      work.push_back(i);
  const Configured& c = scope.step.configured;
  std::vector<Verdict> verdicts;
  scope.run_items(1, [&](std::size_t) {
    Making making;
    verdicts = scope.cached<std::vector<Verdict>>(
        c, atlas_key(known.atlas), making, [&](const Context& context) {
          return c.as<LoopVerifier>().verify(known.atlas, work, context);
        });
    return making;
  });
  if (verdicts.size() != work.size())
    throw Error(ErrorCode::plugin, scope.step.registered->library,
                fmt::format("'{}' gave {} verdicts for {} loops", scope.step.plugin,
                            verdicts.size(), work.size()));
  std::size_t accepted = 0;
  for (std::size_t i = 0; i < work.size(); ++i) {
    Loop& loop = loops[work[i]];
    loop.state = verdicts[i].accepted ? LoopState::accepted : LoopState::rejected;
    loop.decided_by = scope.step.plugin;
    loop.reason = verdicts[i].reason;
    accepted += verdicts[i].accepted;
  }
  scope.record.summary = fmt::format("{} of {} loops accepted", accepted, work.size());
  return known;
}

}  // namespace cambium
