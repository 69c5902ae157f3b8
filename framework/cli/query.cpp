// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/query.hpp"

#include <fmt/format.h>

#include "cambium/files.hpp"
#include "engine/output_folder.hpp"
#include "engine/resolve.hpp"
#include "host.hpp"

namespace cambium::cli {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string map;
  monitor::PlaceOptions place;
  monitor::QueryOptions query;
  fs::path out;
  std::vector<std::string> exporters{"cloud"};
  bool json = false;
  PluginOptions plugins;
  EngineFlags engine;
};

/// The cropped map through exporters, each into its folder; what they wrote.
std::vector<fs::path> export_place(const Options& o, const monitor::QueryResult& result,
                                   const Registry& registry, const Engine& engine) {
  std::vector<fs::path> files;
  for (const std::string& name : o.exporters) {
    Diagnostics diagnostics;
    const auto exporter =
        configure(registry, Kind::map_exporter, name, "--export", {}, diagnostics);
    diagnostics.throw_if_any();
    fs::create_directories(o.out / name);
    const auto context = engine.context(Hasher().add("query").add(name).digest(), 1);
    for (const fs::path& file :
         exporter->as<MapExporter>().write(result.cropped, o.out / name, *context))
      files.push_back(file);
  }
  return files;
}

void run(Options o) {
  o.query.place = monitor::parse_place(o.place);
  if (!o.out.empty()) open_output_folder(o.out, "place.json", "the answer to a query");
  const PluginLoader loader = o.plugins.load();
  Progress progress = o.engine.progress();
  const Engine engine(o.engine.options(), progress);
  const auto survey = monitor::open_survey(o.map, loader.registry(), engine);
  const auto result = monitor::query(survey, o.query, *engine.context(Digest{}, 1));
  auto json = monitor::query_json(survey, result);
  if (!o.out.empty()) {
    // First, too: it marks the folder as ours if an exporter fails.
    write_file(o.out / "place.json", json.dump(1) + "\n");
    write_file(o.out / "stems.geojson", monitor::query_stems_geojson(survey, result));
    json["files"] = monitor::Json::array({(o.out / "stems.geojson").string()});
    for (const fs::path& file : export_place(o, result, loader.registry(), engine))
      json["files"].push_back(file.string());
    write_file(o.out / "place.json", json.dump(1) + "\n");
  }
  fmt::print("{}", o.json ? json.dump(1) + "\n" : monitor::query_text(survey, result));
}

void add_place_options(CLI::App& sub, Options& o) {
  sub.add_option("--at", o.place.at, "Middle of a circle: LAT,LON")->type_name("LAT,LON");
  sub.add_option("--radius", o.place.radius, "Of the circle, such as 15m")->type_name("LENGTH");
  sub.add_option("--box", o.place.box, "Two corners: LAT,LON,LAT,LON")->type_name("A,B,C,D");
  sub.add_option("--polygon", o.place.polygon, "GeoJSON file with a polygon, or several")
      ->type_name("FILE");
  sub.add_option("--epsg", o.place.epsg,
                 "System that these coordinates are in, such as 3067; a plane one takes EAST,NORTH "
                 "(default: WGS 84)")
      ->type_name("CODE");
}

}  // namespace

void add_query(CLI::App& app) {
  auto o = std::make_shared<Options>();
  CLI::App* sub = app.add_subcommand("query", "Say what a map knows of a place, by coordinates");
  sub->add_option("RUN", o->map, "Run folder, RUN:MISSION, or a georeferenced mission")->required();
  add_place_options(*sub, *o);
  sub->add_option("--reach", o->query.reach, "Nodes farther from the place did not see it [m]")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  sub->add_option("--min-sightings", o->query.stems.min_sightings,
                  "A tree was seen by so many nodes")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  sub->add_option("--out,-o", o->out, "Folder for place.json, stems.geojson and exports");
  sub->add_option("--export", o->exporters,
                  "Exporter that writes the map cut to the place into --out; may be given several "
                  "times")
      ->allow_extra_args(false)
      ->capture_default_str();
  sub->add_flag("--json", o->json, "Print JSON");
  o->plugins.add_to(*sub);
  o->engine.add_to(*sub);
  sub->footer(
      "Exit code 1: no mission saw the place.\n"
      "Example: cambium query fused --at 61.2003,25.1004 --radius 15m --out place --export cloud");
  sub->callback([o] { run(*o); });
}

}  // namespace cambium::cli
