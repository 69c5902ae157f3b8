// SPDX-License-Identifier: BSD-3-Clause
// The map for GIS and web maps: GeoJSON (RFC 7946), WGS 84, one file a layer.
#include <string>

#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "common/geojson_text.hpp"

namespace {

using namespace cambium;
using namespace map_export;

/// By island; warns of those that the globe has no place for.
std::vector<std::optional<GeoReference>> georeferences(const Atlas& atlas, const Context& context) {
  std::vector<std::optional<GeoReference>> out;
  for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
    out.push_back(georeference(atlas, atlas.islands[i]));
    if (!out.back())
      context.warn("island " + std::to_string(i) + " (mission " +
                   atlas.missions[atlas.islands[i].missions.front()].mission->name +
                   ") has no georeference and is not in the GeoJSON; add a georeference step");
  }
  return out;
}

class GeoJson final : public MapExporter {
 public:
  void params(ParamVisitor& v) override { options_.params(v); }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    const auto places = georeferences(atlas, context);
    const auto layers = layers_of(atlas, options_, context);
    context.expect(layers.size());
    std::vector<std::filesystem::path> written;
    for (const Layer& layer : layers) {
      const auto path = folder / (layer.name + ".geojson");
      if (write_layer(layer, places, path, context)) written.push_back(path);
      context.advance();
    }
    return written;
  }

 private:
  /// False, and no file, when no feature has a place on the globe.
  static bool write_layer(const Layer& layer,
                          const std::vector<std::optional<GeoReference>>& places,
                          const std::filesystem::path& path, const Context& context) {
    std::string features;
    for (const Feature& feature : layer.features) {
      context.check_cancelled();
      if (!places[feature.island]) continue;
      features += features.empty() ? "\n" : ",\n";
      features += feature_text(layer, feature, *places[feature.island]);
    }
    if (features.empty()) return false;
    write_file(path, feature_collection(features));
    return true;
  }

  LayerOptions options_;
};

}  // namespace

CAMBIUM_PLUGIN("geojson", "0.1.0") {
  registry.add<GeoJson>("geojson",
                        "Tracks, nodes, loops and stems as GeoJSON (WGS 84), for GIS and web maps");
}
