// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "cambium/dialect.hpp"
#include "engine/open_run.hpp"
#include "engine/split.hpp"
#include "host.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  fs::path run, at, out;
  std::string mission;
  PluginOptions plugins;
  EngineFlags engine;
};

std::vector<StampedPose> odometry_of(const Mission& mission) {
  const fs::path file = mission.folder / "odometry.tum";
  return fs::exists(file) ? read_tum(file) : std::vector<StampedPose>{};
}

/// One mission's rows, for the stamps within its path.
std::size_t append(const MissionState& state, const std::vector<Stamp>& stamps, std::string& out) {
  const Interpolator path(state, odometry_of(*state.mission));
  std::size_t rows = 0;
  for (const Stamp& stamp : stamps) {
    const auto T = path.T_map_base(stamp);
    if (!T) continue;
    out += fmt::format("{},{},{}", state.mission->name, stamp.sec, stamp.nsec);
    for (int i = 0; i < 3; ++i) out += ',' + format_number(T->t[i]);
    for (int i = 0; i < 4; ++i) out += ',' + format_number(T->q.coeffs()[i]);
    out += '\n';
    ++rows;
  }
  return rows;
}

void run(const Options& o) {
  const PluginLoader loader = o.plugins.load();
  const auto stamps = parse_stamps(read_file(o.at), o.at);
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const Atlas atlas = open_run(o.run, loader.registry(), engine);
  std::string text = "mission,sec,nsec,x,y,z,qx,qy,qz,qw\n";
  std::size_t rows = 0;
  bool known = o.mission.empty();
  for (const MissionState& state : atlas.missions) {
    if (!o.mission.empty() && state.mission->name != o.mission) continue;
    known = true;
    rows += append(state, stamps, text);
  }
  if (!known)
    throw Error(ErrorCode::config, "--mission",
                fmt::format("the run has no mission '{}'", o.mission));
  if (rows < stamps.size())
    progress.log(LogLevel::warning, fmt::format("{} of {} stamps lie on no mission's path",
                                                stamps.size() - rows, stamps.size()));
  if (o.out.empty())
    fmt::print("{}", text);
  else
    write_file(o.out, text);
}

}  // namespace

void add_poses(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("poses", "Poses in the map at the stamps of other sensors");
  sub->add_option("RUN", o->run, "Run folder, as 'cambium run --out' wrote it")->required();
  sub->add_option("--at", o->at, "Table of stamps: seconds, sec,nsec or nanoseconds")->required();
  sub->add_option("--mission", o->mission, "Of this mission only (default: of all that were on)");
  sub->add_option("--out,-o", o->out, "File to write (default: the terminal)");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Between nodes a mission's odometry.tum is followed where it exists, else the geodesic.\n"
      "Example: cambium poses fused --at camera/data.csv --mission mission_a --out camera.csv");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
