// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/inspection.hpp"
#include "host.hpp"
#include "inspect_report.hpp"
#include "read_one.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path mission;
  std::string reader, params = "{}";
  bool json = false;
  PluginOptions plugins;
  EngineFlags engine;
};

Mission read(const Options& o, const Registry& registry, const Engine& engine) {
  // Readers that can look closely into their files do so here: that is what the user came for.
  const auto check = [](Component& reader, Yaml& params) {
    set_if_known(reader, params, "check_payloads", "true");
  };
  return read_one({o.mission, o.reader, o.params}, check, registry, engine);
}

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const Mission mission = read(o, loader.registry(), engine);
  const auto parallel_for = [&](std::size_t n, const std::function<void(std::size_t)>& body) {
    engine.parallel_for(n, body);
  };
  const Inspection inspection = inspect(mission, parallel_for);
  fmt::print("{}",
             o.json ? inspection_json(mission, inspection) : inspection_text(mission, inspection));
}

}  // namespace

void add_inspect(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("inspect", "Say what is in a mission and what is wrong with it");
  sub->add_option("MISSION", o->mission, "Mission folder or pose graph (.g2o)")->required();
  sub->add_option("--reader", o->reader, "Reader to use; by default the one that knows the format");
  sub->add_option("--params", o->params,
                  "Parameters of the reader, such as '{apply_viewpoint: true}'");
  sub->add_flag("--json", o->json, "Print JSON");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Warnings do not change the exit code; a mission that cannot be read gives 4.\n"
      "Example: cambium inspect missions/mission_a --json");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
