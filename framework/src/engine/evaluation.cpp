// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/open_run.hpp"
#include "engine/run_folder.hpp"
#include "engine/run_step.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> chosen(const EvaluationOptions& options, const Registry& registry) {
  if (!options.evaluators.empty()) return options.evaluators;
  std::vector<std::string> names;
  for (const auto& [key, component] : registry.all())  // but those that need to be told something
    if (key.first == Kind::evaluator && component.create()->check_params().empty())
      names.push_back(key.second);
  return names;
}

/// "ate.alignment=se3" as the override of the step that is the n-th evaluator.
std::string of_step(const std::string& text, const std::vector<std::string>& evaluators) {
  const auto found =
      std::find(evaluators.begin(), evaluators.end(), text.substr(0, text.find('.')));
  if (found == evaluators.end() || text.find('.') == std::string::npos)
    throw Error(
        ErrorCode::config, "--set " + text,
        fmt::format("expected EVALUATOR.PARAM=VALUE with one of: {}", fmt::join(evaluators, ", ")));
  return fmt::format("evaluate[{}]{}", found - evaluators.begin() + 1, text.substr(text.find('.')));
}

}  // namespace

ResolvedPipeline prepare_evaluation(const EvaluationOptions& options, const Registry& registry) {
  if (!options.truth.empty() && !fs::is_directory(options.truth))
    throw Error(ErrorCode::config, options.truth.string(),
                "is no folder; expected one with <mission>/ground_truth.tum or <mission>.tum");
  Pipeline pipeline = filters_of_run(options.run);
  const auto names = chosen(options, registry);
  std::string text = "version: 1\nsteps:\n";
  for (const std::string& name : names) {
    text += fmt::format("  - evaluate: {}\n", name);
    if (!options.truth.empty())
      text += fmt::format("    reference: {}\n",
                          nlohmann::json(fs::absolute(options.truth).string()).dump());
  }
  std::vector<std::string> overrides;
  for (const auto& o : options.overrides) overrides.push_back(of_step(o, names));

  for (StepSpec& step : parse_pipeline(text, "command line", overrides).steps)
    pipeline.steps.push_back(std::move(step));
  return resolve(pipeline, registry);
}

std::vector<StepRecord> evaluate_run(const EvaluationOptions& options,
                                     const ResolvedPipeline& pipeline, const Registry& registry,
                                     const Engine& engine) {
  Known known = known_missions(pipeline, registry, engine);
  known.atlas = read_run(options.run, std::move(known.atlas));
  std::vector<StepRecord> records;
  for (const Step& step : pipeline.steps) {
    auto record = run_step(step, known, engine, pipeline.spec.seed, options.run);
    if (step.verb->kind == Kind::evaluator) records.push_back(std::move(record));
  }
  return records;
}

}  // namespace cambium
