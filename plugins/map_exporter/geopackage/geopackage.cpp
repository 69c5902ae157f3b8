// SPDX-License-Identifier: BSD-3-Clause
// Tracks, nodes, loops and stems in one file that QGIS and every other GIS opens.
#include <map>
#include <optional>

#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "common/crs.hpp"
#include "gdal_file.hpp"

namespace geopackage {

using namespace cambium;
using namespace map_export;

class GeoPackage final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    static const std::string doc =
        std::string(crs_doc) + "; map: the map frames, as systems of their own";
    v("crs", crs_, doc.c_str());
    options_.params(v);
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    const Places places(atlas, crs_);
    const auto layers = layers_of(atlas, options_, context);
    if (layers.empty()) {
      context.warn("geopackage: the map has nothing of what 'layers' asks for; nothing is written");
      return {};
    }
    const auto path = folder / "map.gpkg";
    File file(path, last_stamp(atlas));
    context.expect(layers.size());
    for (const Layer& layer : layers) {
      write_layer(layer, places, file, context);
      context.advance();
    }
    file.commit();
    return {path};
  }

 private:
  /// Where the points of each island go.
  struct Places {
    std::optional<Projection> projection;
    std::vector<std::optional<GeoReference>> georeferences;  ///< by island; nothing: its own frame

    Places(const Atlas& atlas, const std::string& crs) {
      if (crs != "map") projection.emplace(crs_of(crs, atlas));
      for (const Island& island : atlas.islands)
        georeferences.push_back(projection ? georeference(atlas, island)
                                           : std::optional<GeoReference>());
    }
    /// Islands on the globe share their layers; the others have some of their own.
    std::string suffix(std::size_t island) const {
      return georeferences[island] ? "" : "_map_" + std::to_string(island);
    }
    System system(std::size_t island) const {
      if (georeferences[island]) return {projection->crs(), {}};
      return {{}, "Cambium map frame, island " + std::to_string(island)};
    }
    std::string heights(std::size_t island) const {
      return georeferences[island] ? "heights: " + projection->heights()
                                   : "metres in the map frame, not georeferenced";
    }
    Vec3 operator()(std::size_t island, const Vec3& p_map) const {
      const auto& g = georeferences[island];
      return g ? (*projection)(map_to_geodetic(*g, p_map)) : p_map;
    }
  };

  static void write_layer(const Layer& layer, const Places& places, File& file,
                          const Context& context) {
    std::map<std::string, std::vector<const Feature*>> parts;
    for (const Feature& feature : layer.features)
      parts[layer.name + places.suffix(feature.island)].push_back(&feature);
    for (const auto& [name, features] : parts) {
      const std::size_t island = features.front()->island;
      file.begin_layer(name, layer, places.system(island), places.heights(island));
      for (const Feature* feature : features) {
        context.check_cancelled();
        std::vector<Vec3> points;
        for (const Vec3& p : feature->points) points.push_back(places(feature->island, p));
        file.add(layer, points, feature->values);
      }
    }
  }

  static Stamp last_stamp(const Atlas& atlas) {
    Stamp last;
    for (const MissionState& state : atlas.missions)
      for (const Node& node : state.mission->nodes)
        if (node.stamp) last = std::max(last, *node.stamp);
    return last;
  }

  std::string crs_ = "utm";
  LayerOptions options_;
};

}  // namespace geopackage

CAMBIUM_PLUGIN("geopackage", "0.1.0") {
  registry.add<geopackage::GeoPackage>(
      "geopackage", "Tracks, nodes, loops and stems in one GeoPackage (any EPSG code), for QGIS");
}
