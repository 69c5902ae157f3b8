// SPDX-License-Identifier: BSD-3-Clause
#include "engine/report.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"
#include "engine/open_run.hpp"
#include "host.hpp"
#include "report/page.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path run, out;
  PluginOptions plugins;
  EngineFlags engine;
};

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const Atlas atlas = open_run(o.run, loader.registry(), engine);
  const fs::path out = o.out.empty() ? o.run / "report.html" : o.out;
  try {
    const Json report = Json::parse(read_file(o.run / "report.json"));
    write_file(out, report_page(atlas, report, read_file(o.run / "resolved.yaml")));
  } catch (const Json::exception& e) {
    throw Error(
        ErrorCode::data, (o.run / "report.json").string(),
        fmt::format("is not what a run of Cambium writes: {}; run the pipeline again", e.what()));
  }
  fmt::print("{}\n", out.string());
}

}  // namespace

void add_report(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("report", "Write the page that shows a finished run");
  sub->add_option("RUN", o->run, "Run folder, as 'cambium run --out' wrote it")->required();
  sub->add_option("--out,-o", o->out, "File to write (default: RUN/report.html)");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "'cambium run' writes the page itself; this is for runs of earlier versions.\n"
      "Example: cambium report fused --out fused.html");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
