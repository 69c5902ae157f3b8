// SPDX-License-Identifier: BSD-3-Clause
#include "rows.hpp"

#include <cmath>
#include <cstdio>

#include "common/features.hpp"

namespace inventory {
namespace {

using namespace cambium;

/// Empty where a figure is not known.
std::string cell(double value, int digits) {
  if (!std::isfinite(value)) return ",";
  char text[64];
  std::snprintf(text, sizeof text, ",%.*f", digits, value);
  return text;
}

/// RFC 4180: quoted where a folder's name has a comma or a quotation mark.
std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\n") == text.npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + '"';
}

}  // namespace

std::string header() {
  return "id,island,x,y,z,easting,northing,height,latitude,longitude,dbh,dbh_spread,dbh_sigma,"
         "position_spread,score,sightings,missions\n";
}

std::string row(const Atlas& atlas, const Entry& e, const Projection& to_grid) {
  std::string out = std::to_string(e.id) + ',' + std::to_string(e.island);
  for (int k = 0; k < 3; ++k) out += cell(e.stem.base[k], 3);
  if (e.place) {
    const Vec3 p = to_grid(*e.place);
    for (int k = 0; k < 3; ++k) out += cell(p[k], 3);
    out += cell(e.place->latitude, 9) + cell(e.place->longitude, 9);
  } else {
    out += ",,,,,";
  }
  out += cell(e.stem.dbh, 4) + cell(e.stem.dbh_spread, 4) + cell(e.stem.dbh_sigma, 4);
  out += cell(e.stem.base_spread.head<2>().norm(), 3) + cell(e.stem.score, 3);
  out += ',' + std::to_string(e.stem.seen_by.size());
  return out + ',' + csv_text(map_export::missions_of(atlas, e.stem)) + '\n';
}

}  // namespace inventory
