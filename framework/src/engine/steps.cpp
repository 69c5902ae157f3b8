// SPDX-License-Identifier: BSD-3-Clause
#include "engine/steps.hpp"

namespace cambium {

void StepScope::run_items(std::size_t count, const std::function<Making(std::size_t)>& item) const {
  engine.progress().expect(count);
  std::vector<Making> makings(count);
  engine.parallel_for(count, [&](std::size_t i) {
    makings[i] = item(i);
    engine.progress().advance();
  });
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
