// SPDX-License-Identifier: BSD-3-Clause
#include "engine/split.hpp"

#include <fmt/format.h>

#include "cambium/dialect.hpp"
#include "engine/open_run.hpp"
#include "engine/output_folder.hpp"
#include "host.hpp"

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
  open_output_folder(o.out, atlas.missions.front().mission->name, "split missions");
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    const Mission mission = updated_mission(atlas, m);
    const fs::path folder = o.out / mission.name;
    fs::create_directories(folder);
    AtomicFile file(folder / "slam_pose_graph.g2o");
    write_g2o(file.stream(), mission);
    file.commit();
    fmt::print("{}\n", (folder / "slam_pose_graph.g2o").string());
  }
}

}  // namespace

void add_split(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("split", "Write each mission of a run back, with new poses");
  sub->add_option("RUN", o->run, "Run folder, as 'cambium run --out' wrote it")->required();
  sub->add_option("--out,-o", o->out, "Folder for MISSION/slam_pose_graph.g2o")->required();
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Ids, edges and unknown lines are those of the mission, poses and GNSS lines those of the "
      "map.\n"
      "Example: cambium split fused --out updated");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
