// SPDX-License-Identifier: BSD-3-Clause
#include "engine/steps.hpp"

#include <algorithm>

namespace cambium {

void StepScope::run_items(std::size_t count, const std::function<Making(std::size_t)>& item) const {
  engine.progress().expect(count);
  std::vector<Making> makings(count);
  const auto one = [&](std::size_t i) {
    makings[i] = item(i);
    engine.progress().advance();
  };
  // In blocks, so that memory is looked at in between; large enough to keep all threads busy.
  const std::size_t block = 64 * std::size_t(engine.threads());
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t size = std::min(block, count - begin);
    if (engine.within_memory(step.title()))
      engine.parallel_for(size, [&](std::size_t i) { one(begin + i); });
    else
      for (std::size_t i = begin; i < begin + size; ++i) {
        engine.parallel_for(1, [&](std::size_t) { one(i); });
        engine.within_memory(step.title());
      }
  }
  record.items += count;
  for (const Making& m : makings) {
    record.cached += m.hit;
    record.work += m.seconds;
  }
}

Digest StepScope::item_key(const Configured& c, const Digest& input) const {
  return Hasher()
      .add("cambium-item-1")
      .add(engine.build())
      .add(c.key)
      .add(input)
      .add(seed)
      .digest();
}

StepFunction step_function(Kind kind) {
  switch (kind) {
    case Kind::payload_filter:
      return &run_filter;
    case Kind::place_recognizer:
      return &run_recognize;
    case Kind::registration:
      return &run_register;
    case Kind::loop_verifier:
      return &run_verify;
    case Kind::solver:
      return &run_optimize;
    case Kind::gnss_aligner:
      return &run_georeference;
    case Kind::map_exporter:
      return &run_export;
    case Kind::evaluator:
      return &run_evaluate;
    case Kind::mission_reader:
      break;  // missions are read before the first step
  }
  throw Error(ErrorCode::config, "", "a mission reader is not a step");
}

}  // namespace cambium
