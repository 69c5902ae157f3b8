// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run.hpp"

#include <fmt/format.h>

#include "host.hpp"

namespace cambium::cli {
namespace {

struct Options {
  RunOptions run;
  PluginOptions plugins;
  EngineFlags engine;
};

void print_metrics(const std::vector<Metric>& metrics) {
  std::size_t width = 0;
  for (const auto& m : metrics) width = std::max(width, m.name.size());
  for (const auto& m : metrics)
    fmt::print("{:<{}}  {:>10.4g} {}\n", m.name, width, m.value, m.unit);
}

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  const ResolvedPipeline pipeline = prepare_run(o.run, loader.registry());
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const RunResult result = run_pipeline(o.run, pipeline, loader.registry(), engine);
  print_metrics(result.known.metrics);
  progress.log(LogLevel::info,
               fmt::format("map: {}, report: {}", (o.run.out / "fused.g2o").string(),
                           (o.run.out / "report.json").string()));
}

}  // namespace

void add_run(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("run", "Run a pipeline over missions and write a run folder");
  sub->add_option("PIPELINE", o->run.pipeline, "Pipeline file (YAML)")->required();
  sub->add_option("MISSION", o->run.missions,
                  "Mission folders, .g2o files or globs; they replace those of the pipeline");
  sub->add_option("--out,-o", o->run.out, "Run folder; new, empty, or of an earlier run")
      ->required();
  sub->add_option("--set", o->run.overrides,
                  "One parameter: VERB.PARAM=VALUE for every step of the verb, VERB[n].PARAM=VALUE "
                  "for the n-th")
      ->allow_extra_args(false);
  sub->add_option("--seed", o->run.seed, "Replaces the pipeline's seed");
  sub->add_flag("--explain", o->run.explain, "Say for every step why it ran again");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Example: cambium run pipelines/fuse_scans.yaml mission_a mission_b --out fused "
      "--set optimize.loss=huber");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
