// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/json.hpp"

#include <cmath>

#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"

namespace cambium::monitor {

Json rounded(double value, int digits) {
  if (!std::isfinite(value)) return {};
  const double scale = std::pow(10.0, digits);
  return std::round(value * scale) / scale;
}

GeoReference island_reference(const Survey& survey, std::uint32_t island) {
  return georeference(survey.clouds, survey.clouds.islands[island]).value();
}

void add_place(Json& row, const Vec3& p_map, const std::optional<GeoReference>& g) {
  row["x"] = rounded(p_map.x(), 3);
  row["y"] = rounded(p_map.y(), 3);
  row["z"] = rounded(p_map.z(), 3);
  if (!g) return;
  const Geodetic place = map_to_geodetic(*g, p_map);
  row["latitude"] = rounded(place.latitude, 9);
  row["longitude"] = rounded(place.longitude, 9);
  row["altitude"] = rounded(place.altitude, 3);
}

std::string mission_names(const Atlas& atlas, const Stem& stem) {
  std::string out;
  for (const std::uint32_t m : stem.missions())
    out += (out.empty() ? "" : ";") + atlas.missions[m].mission->name;
  return out;
}

Json position(const GeoReference& g, const Vec3& p_map) {
  const Geodetic place = map_to_geodetic(g, p_map);
  return {rounded(place.longitude, 9), rounded(place.latitude, 9), rounded(place.altitude, 3)};
}

Json point_feature(const GeoReference& g, const Vec3& p_map, const Json& properties) {
  Json out;
  out["type"] = "Feature";
  out["properties"] = properties;
  out["geometry"] = {{"type", "Point"}, {"coordinates", position(g, p_map)}};
  return out;
}

std::string feature_collection(Json features) {
  std::string out = "{\"type\":\"FeatureCollection\",\"features\":[";
  for (std::size_t i = 0; i < features.size(); ++i) out += (i ? ",\n" : "\n") + features[i].dump();
  return out + "\n]}\n";
}

}  // namespace cambium::monitor
