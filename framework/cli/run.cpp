// SPDX-License-Identifier: BSD-3-Clause
#include "engine/run.hpp"

#include <fmt/format.h>

#include "host.hpp"
#include "metric_table.hpp"
#include "shards/plan.hpp"

namespace cambium::cli {
namespace {

struct Options {
  RunOptions run;
  std::string shard;
  std::size_t wave = 1;
  PluginOptions plugins;
  EngineFlags engine;
};

// At most so many files of one export are named; of more, their folder.
constexpr std::size_t few = 3;

void print_files(const std::vector<StepRecord>& steps, const std::filesystem::path& out) {
  fmt::print("{:<14} {}\n", "report", (out / "report.html").string());
  fmt::print("{:<14} {}\n", "pose graph", (out / "fused.g2o").string());
  for (const auto& step : steps) {
    if (step.files.size() > few)
      fmt::print("{:<14} {} ({} files)\n", step.plugin, step.files.front().parent_path().string(),
                 step.files.size());
    else
      for (const auto& file : step.files) fmt::print("{:<14} {}\n", step.plugin, file.string());
  }
}

void run_shard(const Options& o) {
  const auto [index, count] = parse_shard(o.shard);
  const PluginLoader loader = o.plugins.load();
  const shards::Plan plan = shards::read_plan(o.run.pipeline);
  const EngineOptions options = o.engine.options();
  if (!options.cache)
    throw Error(ErrorCode::config, "--cache", "a shard leaves its results in a cache; name one");
  Progress progress = o.engine.progress();
  const Engine engine(options, progress);
  const auto records =
      run_share(shards::pipeline_of(plan, o.run.pipeline, loader.registry()),
                {o.wave, shards::shard(plan, index, count)}, loader.registry(), engine);
  std::size_t items = 0, cached = 0;
  for (const StepRecord& r : records) items += r.items, cached += r.cached;
  fmt::print("shard {} of wave {}: {} items, {} of them from the cache\n", o.shard, o.wave, items,
             cached);
}

void run(const Options& o) {
  if (!o.shard.empty()) return run_shard(o);
  if (o.run.out.empty()) throw Error(ErrorCode::config, "", "--out is required");
  const PluginLoader loader = o.plugins.load();
  const ResolvedPipeline pipeline = prepare_run(o.run, loader.registry());
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const RunResult result = run_pipeline(o.run, pipeline, loader.registry(), engine);
  if (!result.known.metrics.empty()) fmt::print("\n{}\n", headline_table(result.steps));
  print_files(result.steps, o.run.out);
}

}  // namespace

void add_run(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("run", "Run a pipeline over missions and write a run folder");
  sub->add_option("PIPELINE", o->run.pipeline, "Pipeline file (YAML), or a plan with --shard")
      ->required();
  sub->add_option("MISSION", o->run.missions,
                  "Mission folders, .g2o files or globs; they replace those of the pipeline");
  sub->add_option("--out,-o", o->run.out, "Run folder; new, empty, or of an earlier run");
  sub->add_option("--set", o->run.overrides,
                  "One parameter: VERB.PARAM=VALUE for every step of the verb, VERB[n].PARAM=VALUE "
                  "for the n-th")
      ->allow_extra_args(false);
  sub->add_option("--seed", o->run.seed, "Replaces the pipeline's seed");
  sub->add_flag("--explain", o->run.explain, "Say for every step why it ran again");
  sub->add_option("--shard", o->shard,
                  "I/N: compute only this part of a plan, into the cache; see 'cambium plan'");
  sub->add_option("--wave", o->wave, "Of a shard: which of the plan's waves")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Example: cambium run pipelines/fuse_scans.yaml mission_a mission_b --out fused "
      "--set optimize.loss=huber");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
