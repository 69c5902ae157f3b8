// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/law.hpp"

namespace cambium::conformance {

// Half a gigabyte is plenty for the forest of the kit; there is no cache, so that every call runs.
Host::Host(int threads)
    : progress_(Progress::Style::quiet, LogLevel::error),
      engine_({threads, std::size_t(1) << 29, std::nullopt, &cancelled_}, progress_) {}

std::unique_ptr<Context> Host::context(std::uint64_t seed) const {
  return engine_.context(Hasher().add("conformance").digest(), seed);
}

Exercise exercise(const Subject& subject) {
  switch (subject.registered.kind) {
    case Kind::mission_reader:
      return exercise_reader(subject);
    case Kind::payload_filter:
      return exercise_filter(subject);
    case Kind::place_recognizer:
      return exercise_recognizer(subject);
    case Kind::registration:
      return exercise_registration(subject);
    case Kind::loop_verifier:
      return exercise_verifier(subject);
    case Kind::solver:
      return exercise_solver(subject);
    case Kind::gnss_aligner:
      return exercise_aligner(subject);
    case Kind::map_exporter:
      return exercise_exporter(subject);
    case Kind::evaluator:
      return exercise_evaluator(subject);
  }
  throw Error(ErrorCode::plugin, subject.registered.name, "is of a kind that this program lacks");
}

}  // namespace cambium::conformance
