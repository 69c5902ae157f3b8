// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/inspection.hpp"
#include "engine/resolve.hpp"
#include "host.hpp"
#include "inspect_report.hpp"
#include "pipeline/params.hpp"

namespace cambium::cli {
namespace {

struct Options {
  std::filesystem::path mission;
  std::string reader, params = "{}";
  bool json = false;
  PluginOptions plugins;
  EngineFlags engine;
};

// Readers that can look closely into their files do so here: that is what the user came for.
Yaml with_checks(Component& reader, Yaml params) {
  const std::string name = "check_payloads";
  for (const ParamInfo& info : list_params(reader)) {
    if (info.name != name || params.find(name)) continue;
    Yaml key, value;
    params.type = Yaml::Type::map;
    key.type = value.type = Yaml::Type::scalar;
    key.scalar = name;
    value.scalar = "true";
    params.set(key, value);
  }
  return params;
}

std::string reader_for(const std::filesystem::path& mission, const Registry& registry) {
  std::vector<std::string> accepting;
  for (const auto& [key, registered] : registry.all()) {
    if (key.first != Kind::mission_reader) continue;
    const auto reader = registered.create();
    if (dynamic_cast<const MissionReader&>(*reader).accepts(mission))
      accepting.push_back(key.second);
  }
  if (accepting.size() == 1) return accepting[0];
  throw Error(accepting.empty() ? ErrorCode::data : ErrorCode::config, mission.string(),
              accepting.empty()
                  ? "no reader knows it; expected a mission folder (with slam_pose_graph.g2o) or a "
                    "pose graph (.g2o)"
                  : fmt::format("more than one reader knows it; name one with --reader: {}",
                                fmt::join(accepting, ", ")));
}

Mission read(const Options& o, const Registry& registry, const Engine& engine) {
  if (!std::filesystem::exists(o.mission))
    throw Error(ErrorCode::data, o.mission.string(), "does not exist");
  const std::string name = o.reader.empty() ? reader_for(o.mission, registry) : o.reader;
  const Registered* registered = registry.find(Kind::mission_reader, name);
  Diagnostics diagnostics;
  Yaml params = parse_yaml(o.params, "--params", diagnostics);
  if (registered) params = with_checks(*registered->create(), params);
  const auto reader =
      configure(registry, Kind::mission_reader, name, "--reader", params, diagnostics);
  diagnostics.throw_if_any();
  return reader->as<MissionReader>().read(o.mission, *engine.context(Digest{}, 0));
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
