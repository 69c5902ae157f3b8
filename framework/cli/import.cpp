// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <filesystem>

#include "engine/mission_files.hpp"
#include "host.hpp"
#include "read_one.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  WhatToRead what;
  std::string cloud, odometry, node_every, between;
  fs::path out;
  PluginOptions plugins;
  EngineFlags engine;
};

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  NewFolder folder(o.out);
  const auto adjust = [&](Component& reader, Yaml& params) {
    const std::pair<const char*, const std::string&> options[] = {{"cloud", o.cloud},
                                                                  {"odometry", o.odometry},
                                                                  {"node_every", o.node_every},
                                                                  {"between", o.between}};
    for (const auto& [name, value] : options)
      if (!value.empty()) set_param(params, name, value, std::string("option of ") + name);
    set_if_known(reader, params, "side_folder", fs::absolute(folder.temporary()).string());
  };
  Mission mission = read_one(o.what, adjust, loader.registry(), engine);
  mission.name = fs::absolute(o.out / "").parent_path().filename().string();
  for (const std::string& warning : mission.warnings) progress.log(LogLevel::warning, warning);
  const WrittenMission written = write_mission(mission, folder.temporary(), engine);
  if (written.other_pictures + written.inertial > 0)
    progress.log(LogLevel::warning,
                 fmt::format("a mission folder holds one picture a node and no inertial "
                             "measurements: {} pictures and {} measurements are left out",
                             written.other_pictures, written.inertial));
  folder.commit();
  fmt::print("{}: {} nodes, {} clouds with {} points, {} pictures, {} fixes\n", o.out.string(),
             mission.nodes.size(), written.clouds, written.points, written.pictures,
             mission.fixes.size());
}

}  // namespace

void add_import(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("import", "Make a mission folder of a recording");
  sub->add_option("RECORDING", o->what.path,
                  "ROS 1 .bag, rosbag2 (.db3, folder), .mcap, or what another reader knows")
      ->required();
  sub->add_option("--cloud", o->cloud, "Topic of the clouds, or none");
  sub->add_option("--odometry", o->odometry, "Topic of the poses, or none");
  sub->add_option("--node-every", o->node_every,
                  "A node when the robot has moved so far, or so long after the last: 2m, 0.5s");
  sub->add_option("--between", o->between, "Clouds between nodes: drop, or accumulate in the node");
  sub->add_option("--out,-o", o->out, "Mission folder to write; new or empty")->required();
  sub->add_option("--reader", o->what.reader, "Reader to use; by default the one that knows it");
  sub->add_option("--params", o->what.params,
                  "Further parameters of the reader, such as '{gnss: /fix, max_gap: 0.5}'");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "The topics that a recording holds are listed when one is missing. docs/recordings.md\n"
      "Example: cambium import walk.bag --cloud /points --odometry /odom --node-every 2m "
      "--out mission_a");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
