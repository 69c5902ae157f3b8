// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/cache_upkeep.hpp"
#include "engine/run.hpp"
#include "host.hpp"
#include "shards/plan.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path plan;
  std::vector<std::filesystem::path> caches;
  RunOptions run;
  PluginOptions plugins;
  EngineFlags engine;
};

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  const auto pipeline = shards::pipeline_of(shards::read_plan(o.plan), o.plan, loader.registry());
  const EngineOptions options = o.engine.options();
  if (!options.cache && !o.caches.empty())
    throw Error(ErrorCode::config, "--cache", "merging caches needs one to merge them into");
  Progress progress = o.engine.progress();
  const Engine engine(options, progress);
  for (const auto& cache : o.caches)
    progress.log(LogLevel::info, fmt::format("{}: {} new entries", cache.string(),
                                             adopt_entries(cache, *options.cache)));
  run_pipeline(o.run, pipeline, loader.registry(), engine);
  progress.log(LogLevel::info, fmt::format("map: {}", (o.run.out / "fused.g2o").string()));
}

}  // namespace

void add_merge(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("merge", "Finish a planned run with what its shards computed");
  sub->add_option("PLAN", o->plan, "Written by 'cambium plan'")->required();
  sub->add_option("CACHE", o->caches,
                  "Caches of shards that did not use the one of this run (--cache)");
  sub->add_option("--out,-o", o->run.out, "Run folder; new, empty, or of an earlier run")
      ->required();
  sub->add_flag("--explain", o->run.explain, "Say for every step why it ran again");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "What no shard has computed is computed here; the result is that of 'cambium run'.\n"
      "Example: cambium merge plan.json --cache shared_cache --out fused");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
