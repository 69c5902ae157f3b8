// SPDX-License-Identifier: BSD-3-Clause
// Tracks for GIS: GeoJSON (RFC 7946), WGS 84, one line a mission.
#include <cstdio>
#include <string>

#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) >= 0x20) {
      out += c;
      continue;
    }
    char code[8];
    std::snprintf(code, sizeof code, "\\u%04x", unsigned(c));
    out += code;
  }
  return out + '"';
}

/// Longitude first, as the standard asks. 1e-9 deg are 0.1 mm.
std::string position(const Geodetic& g) {
  char text[96];
  std::snprintf(text, sizeof text, "[%.9f,%.9f,%.3f]", g.longitude, g.latitude, g.altitude);
  return text;
}

std::string track(const Atlas& atlas, std::uint32_t m, std::size_t island, const GeoReference& g) {
  const MissionState& state = atlas.missions[m];
  std::string line;
  for (const SE3& T_map_node : *state.T_map_node) {
    if (!line.empty()) line += ',';
    line += position(map_to_geodetic(g, T_map_node.t));
  }
  const bool one = state.T_map_node->size() == 1;  // a line has at least two positions
  std::string out = "{\"type\":\"Feature\",\"properties\":{\"mission\":";
  out += quoted(state.mission->name);
  out += ",\"platform\":" + std::to_string(state.mission->platform_id);
  out += ",\"island\":" + std::to_string(island);
  out += ",\"nodes\":" + std::to_string(state.T_map_node->size());
  out += ",\"heights\":\"ellipsoidal, WGS 84\"},\"geometry\":{\"type\":";
  out += one ? "\"Point\",\"coordinates\":" : "\"LineString\",\"coordinates\":[";
  out += line;
  out += one ? "}}" : "]}}";
  return out;
}

class GeoJson final : public MapExporter {
 public:
  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::string features;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      context.check_cancelled();
      const auto g = georeference(atlas, atlas.islands[i]);
      if (!g)
        context.warn("island " + std::to_string(i) + " (mission " +
                     atlas.missions[atlas.islands[i].missions.front()].mission->name +
                     ") has no georeference and is not in the GeoJSON; add a georeference step");
      else
        for (const std::uint32_t m : atlas.islands[i].missions) {
          features += features.empty() ? "\n" : ",\n";
          features += track(atlas, m, i, *g);
        }
    }
    if (features.empty()) return {};
    const auto path = folder / "tracks.geojson";
    write_file(path, "{\"type\":\"FeatureCollection\",\"features\":[" + features + "\n]}\n");
    return {path};
  }
};

}  // namespace

CAMBIUM_PLUGIN("geojson", "0.1.0") {
  registry.add<GeoJson>("geojson", "Tracks as GeoJSON (WGS 84), for GIS and web maps");
}
