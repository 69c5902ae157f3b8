// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/changes.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"
#include "engine/output_folder.hpp"
#include "host.hpp"
#include "monitor/changes_output.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string before, after;
  fs::path out;
  monitor::ChangesOptions changes;
  bool json = false;
  PluginOptions plugins;
  EngineFlags engine;
};

void write_files(const Options& o, const monitor::Survey& before, const monitor::Survey& after,
                 const monitor::Changes& changes, const monitor::Json& summary,
                 Progress& progress) {
  const double cell = o.changes.cells.cell_size;
  write_file(o.out / "changes.json", summary.dump(1) + "\n");  // it marks the folder as ours
  write_file(o.out / "stems.csv", monitor::stems_csv(before, changes));
  write_file(o.out / "cells.csv", monitor::cells_csv(before, changes, cell));
  write_file(o.out / "layer.json", monitor::layer_json(before, after, changes, cell).dump() + "\n");
  if (const auto stems = monitor::stems_geojson(before, changes)) {
    write_file(o.out / "stems.geojson", *stems);
    write_file(o.out / "cells.geojson", *monitor::cells_geojson(before, changes, cell));
  } else {
    progress.log(
        LogLevel::warning,
        fmt::format("{} has no georeference, so there is no GeoJSON; the tables are in its "
                    "map frame",
                    before.name));
  }
}

void run(const Options& o) {
  open_output_folder(o.out, "changes.json", "a comparison");
  const PluginLoader loader = o.plugins.load();
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const auto before = monitor::open_survey(o.before, loader.registry(), engine);
  const auto after = monitor::open_survey(o.after, loader.registry(), engine);
  const auto changes = monitor::changes(before, after, o.changes, *engine.context(Digest{}, 1));
  const auto summary = monitor::summary_json(before, after, changes);
  write_files(o, before, after, changes, summary, progress);
  fmt::print("{}", o.json ? summary.dump(1) + "\n" : monitor::summary_text(summary));
}

void add_limits(CLI::App& sub, monitor::ChangesOptions& o) {
  sub.add_option("--match-radius", o.match_radius, "Trees so near each other are the same one [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub.add_option("--min-sightings", o.stems.min_sightings, "A tree was seen by so many nodes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub.add_option("--min-expected", o.min_expected,
                 "A tree is gone, or new, where the other survey should have detected it so often")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub.add_option("--max-growth", o.max_growth,
                 "A thicker tree that the first survey lacks is no new one, but was overlooked [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub.add_option("--cell", o.cells.cell_size, "Width of the cells of ground and canopy [m]")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

void add_changes(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub =
      app.add_subcommand("changes", "Compare two surveys of one place: trees, ground and canopy");
  sub->add_option("BEFORE", o->before, "Run folder, RUN:MISSION, or a georeferenced mission")
      ->required();
  sub->add_option("AFTER", o->after, "The same, of a later time")->required();
  sub->add_option("--out,-o", o->out, "Folder for the tables and maps")->required();
  add_limits(*sub, o->changes);
  sub->add_flag("--json", o->json, "Print JSON");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Two missions that were fused stand in one map; other surveys must be georeferenced, and "
      "are\n"
      "aligned by the trees that they share. A place that one of them did not see is no change.\n"
      "Example: cambium changes fused:spring fused:autumn --out changes");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
