// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"
#include "host.hpp"
#include "simulate/spec_file.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path spec, out;
  EngineFlags engine;
  bool schema = false;
};

void print(const simulate::Summary& s) {
  fmt::print("{:<16} {:>6} {:>10} {:>10} {:>6} {:>9} {:>12}\n", "mission", "nodes", "points",
             "detections", "fixes", "length m", "end error m");
  for (const auto& m : s.missions)
    fmt::print("{:<16} {:>6} {:>10} {:>10} {:>6} {:>9.1f} {:>12.2f}\n", m.name, m.nodes, m.points,
               m.detections, m.fixes, m.length, m.end_error);
  fmt::print("{} stems, {} loops that exist, {} of them between missions\n", s.stems, s.loops,
             s.loops_between);
}

void run(const Options& o) {
  if (o.schema) return fmt::print("{}\n", simulate::spec_schema().dump(2));
  if (o.spec.empty() || o.out.empty())
    throw Error(ErrorCode::config, "simulate", "expected SPEC and OUT, see --help");
  const std::string text = read_file(o.spec);
  const auto spec = simulate::parse_spec(text, o.spec.string());
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  print(simulate::simulate(spec, text, o.out, *engine.context(digest_bytes(text), 1)));
  progress.log(LogLevel::info,
               fmt::format("truth: {}, {}, and ground_truth.tum in each mission",
                           (o.out / "stems.csv").string(), (o.out / "loops.csv").string()));
}

}  // namespace

void add_simulate(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("simulate", "Mission folders from a forest with known truth");
  sub->add_option("SPEC", o->spec, "Specification (YAML), see docs/simulate.md");
  sub->add_option("OUT", o->out, "Folder to write; new, empty, or of the same specification");
  sub->add_flag("--schema", o->schema, "Print the JSON Schema of a specification instead");
  o->engine.add_to(*sub);
  sub->footer("Example: cambium simulate pipelines/demo/forest.yaml demo_missions");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
