// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/truth.hpp"
#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

// The truth is an input like any other: when a file of it changes, the metrics are computed again.
Digest truth_key(const std::filesystem::path& reference, const Atlas& atlas) {
  Hasher hasher;
  for (const auto& m : atlas.missions) {
    const auto file = truth_file(*m.mission, reference);
    if (std::filesystem::is_regular_file(file)) hasher.add(file.string()).add(digest_file(file));
  }
  return hasher.digest();
}

bool has_truth(const std::filesystem::path& reference, const Atlas& atlas) {
  return !reference.empty() ||
         std::any_of(atlas.missions.begin(), atlas.missions.end(), [](const MissionState& m) {
           return std::filesystem::exists(truth_file(*m.mission, {}));
         });
}

}  // namespace

Known run_evaluate(Known known, const StepScope& scope) {
  const Configured& c = scope.step.configured;
  const std::filesystem::path reference = scope.step.keys.reference;
  if (c.as<Evaluator>().needs_truth() && !has_truth(reference, known.atlas)) {
    scope.record.summary = "skipped: no ground truth";
    scope.engine.progress().log(
        LogLevel::warning, fmt::format("'{}' is skipped: no mission has a ground_truth.tum and "
                                       "the step names no 'reference'",
                                       scope.step.title()));
    return known;
  }
  std::vector<Metric> metrics;
  scope.run_items(1, [&](std::size_t) {
    Making making;
    const Digest input =
        Hasher().add(atlas_key(known.atlas)).add(truth_key(reference, known.atlas)).digest();
    metrics = scope.cached<std::vector<Metric>>(c, input, making, [&](const Context& context) {
      return c.as<Evaluator>().evaluate(known.atlas, reference, context);
    });
    return making;
  });
  scope.record.metrics = metrics;
  const std::string& label = scope.step.keys.label;
  for (Metric& m : metrics)
    if (!label.empty()) m.name = label + "." + m.name;
  scope.record.summary = fmt::format("{} metrics", metrics.size());
  if (!metrics.empty())
    scope.record.summary += fmt::format(", {} {:.4g} {}", metrics.front().name,
                                        metrics.front().value, metrics.front().unit);
  known.metrics.insert(known.metrics.end(), metrics.begin(), metrics.end());
  return known;
}

}  // namespace cambium
