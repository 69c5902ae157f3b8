// SPDX-License-Identifier: BSD-3-Clause
// What GeoJSON (RFC 7946) is made of.
#pragma once
#include <cmath>
#include <cstdio>
#include <string>

#include "cambium/geodesy.hpp"
#include "common/features.hpp"
#include "common/iso_time.hpp"

namespace cambium::map_export {

/// A JSON string.
inline std::string quoted(const std::string& text) {
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
inline std::string position(const Geodetic& g) {
  char text[96];
  std::snprintf(text, sizeof text, "[%.9f,%.9f,%.3f]", g.longitude, g.latitude, g.altitude);
  return text;
}

/// A value of a layer; null where it is not known.
inline std::string json_value(const Value& value, const Field& field) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* words = std::get_if<std::string>(&value)) return quoted(*words);
  if (const auto* stamp = std::get_if<Stamp>(&value)) return quoted(iso_time(*stamp));
  const auto* number = std::get_if<double>(&value);
  if (!number || !std::isfinite(*number)) return "null";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", field.digits, *number);
  return text;
}

/// A feature of `layer` on the globe. A line of one point is a point.
inline std::string feature_text(const Layer& layer, const Feature& feature,
                                const GeoReference& georeference) {
  std::string out = "{\"type\":\"Feature\",\"properties\":{";
  for (std::size_t i = 0; i < layer.fields.size(); ++i) {
    if (i) out += ',';
    out += quoted(layer.fields[i].name) + ':' + json_value(feature.values[i], layer.fields[i]);
  }
  const bool line = feature.points.size() > 1;
  out += "},\"geometry\":{\"type\":";
  out += line ? "\"LineString\",\"coordinates\":[" : "\"Point\",\"coordinates\":";
  for (std::size_t i = 0; i < feature.points.size(); ++i) {
    if (i) out += ',';
    out += position(map_to_geodetic(georeference, feature.points[i]));
  }
  return out + (line ? "]}}" : "}}");
}

inline std::string feature_collection(const std::string& features) {
  return "{\"type\":\"FeatureCollection\",\"features\":[" + features + "\n]}\n";
}

}  // namespace cambium::map_export
