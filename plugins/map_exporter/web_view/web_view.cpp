// SPDX-License-Identifier: BSD-3-Clause
// The map as a page to walk through in a browser.
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "island_data.hpp"
#include "page_files.hpp"

namespace web_view {
namespace {

using namespace cambium;
namespace fs = std::filesystem;

class WebView final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("voxel_size", settings_.voxel_size,
      "Of each mission one point is kept in a voxel of this width; 0 keeps every point",
      at_least(0, "m"));
    v("tile_points", settings_.tile_points, "A cube with more points is divided into octants",
      between(100, 1'000'000));
    v("pair_points", settings_.pair_points,
      "About so many points of each cloud for looking at a loop; 0: none", between(0, 10'000'000));
    v("stem_sightings", settings_.stem_sightings,
      "A tree is shown when so many nodes detected its stem", between(1, 1000));
    v("images", settings_.images, "Copy the pictures that missions took at their nodes");
  }

  std::vector<fs::path> write(const Atlas& atlas, const fs::path& folder,
                              const Context& context) const override {
    // A page of an earlier map must not be met with tiles of this one: its map.json goes first and
    // comes last.
    for (const char* old : {"map.json", "layers.json", "tiles", "pairs", "images"})
      fs::remove_all(folder / old);
    Output output{folder, {}};
    for (const auto& [name, text] : page_files()) output.write(name, text);
    // Filled by `cambium view`; not among the files of the export, which would be stale then.
    write_file(folder / "layers.json", "[]\n");
    Json map{{"format", 1}};
    map["missions"] = missions_json(atlas);
    Json islands = Json::array(), stems = Json::array(), images = Json::array();
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      context.check_cancelled();
      islands.push_back(write_island(atlas, i, settings_, context, output, stems, images));
    }
    map["islands"] = std::move(islands);
    map["stages"] = stages_json(atlas);
    map["loops"] = loops_json(atlas);
    map["stems"] = std::move(stems);
    map["images"] = std::move(images);
    write_file(folder / "map.json", map.dump(-1, ' ', false, Json::error_handler_t::replace));
    output.files.push_back(folder / "map.json");
    return std::move(output.files);
  }

  std::string start_page() const override { return "index.html"; }

 private:
  Settings settings_;
};

}  // namespace
}  // namespace web_view

CAMBIUM_PLUGIN("web_view", "0.1.0") {
  registry.add<web_view::WebView>("web_view", "The map as a page to walk through in a browser");
}
