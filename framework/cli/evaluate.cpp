// SPDX-License-Identifier: BSD-3-Clause
#include "engine/evaluation.hpp"

#include <fmt/format.h>

#include "host.hpp"
#include "metric_table.hpp"

namespace cambium::cli {
namespace {

struct Options {
  EvaluationOptions evaluation;
  PluginOptions plugins;
  EngineFlags engine;
};

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  const auto pipeline = prepare_evaluation(o.evaluation, loader.registry());
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const auto steps = evaluate_run(o.evaluation, pipeline, loader.registry(), engine);
  fmt::print("{}", full_table(steps));
}

}  // namespace

void add_evaluate(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("evaluate", "Measure a finished run against the truth");
  sub->add_option("RUN", o->evaluation.run, "Run folder, as 'cambium run --out' wrote it")
      ->required();
  sub->add_option(
      "TRUTH", o->evaluation.truth,
      "Folder with <mission>/ground_truth.tum or <mission>.tum (default: each mission's "
      "own ground_truth.tum)");
  sub->add_option("--evaluator,-e", o->evaluation.evaluators,
                  "An evaluator plugin; may be given several times (default: all that run with their defaults)")
      ->allow_extra_args(false);
  sub->add_option("--set", o->evaluation.overrides, "One parameter: EVALUATOR.PARAM=VALUE")
      ->allow_extra_args(false);
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Example: cambium evaluate out/demo/map out/demo/missions -e ate -e rpe "
      "--set ate.alignment=se3");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
