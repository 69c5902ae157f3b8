// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/run.hpp"
#include "host.hpp"

namespace cambium::cli {

void add_validate(CLI::App& app) {
  struct Options {
    RunOptions run;
    PluginOptions plugins;
    bool resolved = false;
  };
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("validate", "Check a pipeline without running it");
  sub->add_option("PIPELINE", o->run.pipeline, "Pipeline file (YAML)")->required();
  sub->add_option("--set", o->run.overrides, "As in 'cambium run'")->allow_extra_args(false);
  sub->add_flag("--resolved", o->resolved, "Print the pipeline with every default written out");
  o->plugins.add_to(*sub);
  sub->footer("Example: cambium validate pipelines/fuse_scans.yaml");
  sub->callback([o] {
    const PluginLoader loader = o->plugins.load();
    const ResolvedPipeline p = prepare_run(o->run, loader.registry());
    if (o->resolved)
      fmt::print("{}", to_yaml(p));
    else
      fmt::print("{}: {} steps, no mistakes\n", o->run.pipeline.string(), p.steps.size());
  });
}

}  // namespace cambium::cli
