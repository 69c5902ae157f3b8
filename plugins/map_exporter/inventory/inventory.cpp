// SPDX-License-Identifier: BSD-3-Clause
// The trees of a map as a table and as points on the globe, each tree once.
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "common/crs.hpp"
#include "common/geojson_text.hpp"
#include "rows.hpp"

namespace inventory {

using namespace cambium;

class Inventory final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("crs", crs_, map_export::crs_doc);
    v("radius", options_.radius, "Detections so near each other are one tree", above(0, "m"));
    v("min_sightings", options_.min_sightings, "A tree was detected at so many nodes",
      between(1, 1e6));
    v("only_reconstructed", options_.only_reconstructed,
      "Leave out detections without a stem model");
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    const Projection to_grid(map_export::crs_of(crs_, atlas));
    to_grid.require_plane();
    std::string table, features;
    const map_export::Layer layer = map_export::stem_layer();
    std::size_t trees = 0;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      const auto g = georeference(atlas, atlas.islands[i]);
      for (const Stem& stem : stems_of(atlas, atlas.islands[i].missions, options_, context)) {
        Entry entry{++trees, i, stem, {}};
        if (g) entry.place = map_to_geodetic(*g, stem.base);
        table += row(atlas, entry, to_grid);
        if (g)
          features +=
              (features.empty() ? "\n" : ",\n") +
              map_export::feature_text(layer, map_export::stem_feature(atlas, trees, i, stem), *g);
      }
    }
    if (trees == 0) {
      context.warn(
          "inventory: no node has a tree table with usable trees; nothing is written. Trees in "
          "scans are found by the filter stem_extraction");
      return {};
    }
    const std::string remarks = features.empty()
                                    ? "# crs: none, no island with trees has a georeference\n"
                                    : "# crs: " + to_grid.crs() + " (" + to_grid.name() +
                                          ")\n# heights: " + to_grid.heights() + "\n";
    return write_files(folder, remarks + header() + table, features, context);
  }

 private:
  static std::vector<std::filesystem::path> write_files(const std::filesystem::path& folder,
                                                        const std::string& table,
                                                        const std::string& features,
                                                        const Context& context) {
    std::vector<std::filesystem::path> written{folder / "stems.csv"};
    write_file(written.back(), table);
    if (features.empty()) {
      context.warn(
          "inventory: no island with trees has a georeference, so stems.geojson is not "
          "written; add a georeference step");
      return written;
    }
    written.push_back(folder / "stems.geojson");
    write_file(written.back(), map_export::feature_collection(features));
    return written;
  }

  std::string crs_ = "utm";
  StemOptions options_;
};

}  // namespace inventory

CAMBIUM_PLUGIN("inventory", "0.1.0") {
  registry.add<inventory::Inventory>(
      "inventory", "The trees of the map, each once, as CSV (any EPSG code) and GeoJSON");
}
