// SPDX-License-Identifier: BSD-3-Clause
#include "shards/plan.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"
#include "engine/run.hpp"
#include "host.hpp"

namespace cambium::cli {
namespace {

struct Options {
  RunOptions run;
  PluginOptions plugins;
  EngineFlags engine;
};

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  const ResolvedPipeline pipeline = prepare_run(o.run, loader.registry());
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const shards::Plan plan = shards::make_plan(pipeline, loader.registry(), engine);
  write_file(o.run.out, to_json(plan).dump(1) + "\n");
  double cost = 0;
  for (const shards::Pair& p : plan.pairs) cost += p.cost;
  fmt::print("{} wave(s) of {} pairs of missions, about {:.0f} x candidates registrations each\n",
             plan.waves, plan.pairs.size(), cost);
}

}  // namespace

void add_plan(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("plan", "Prepare a run that several machines share");
  sub->add_option("PIPELINE", o->run.pipeline, "Pipeline file (YAML)")->required();
  sub->add_option("MISSION", o->run.missions, "As in 'cambium run'");
  sub->add_option("--out,-o", o->run.out, "File to write (JSON)")->required();
  sub->add_option("--set", o->run.overrides, "As in 'cambium run'")->allow_extra_args(false);
  sub->add_option("--seed", o->run.seed, "Replaces the pipeline's seed");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Then 'cambium run plan.json --shard 1/4' ... on any machines, and 'cambium merge'.\n"
      "Example: cambium plan pipelines/fuse_scans.yaml missions/* -o plan.json");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
