// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/place.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "cambium/projection.hpp"

namespace cambium::monitor {
namespace {

std::vector<double> numbers(const std::string& text, std::size_t count, const char* option,
                            const char* expected) {
  std::vector<double> out;
  const char *at = text.data(), *const end = at + text.size();
  while (at < end) {
    double value = 0;
    while (at < end && *at == ' ') ++at;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value) || (next != end && *next != ',')) break;
    out.push_back(value);
    at = next == end ? end : next + 1;
  }
  if (at < end || out.size() != count)
    throw Error(ErrorCode::config, option, fmt::format("expected {}, found '{}'", expected, text));
  return out;
}

double length(const std::string& text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [next, error] = std::from_chars(text.data(), end, value);
  const std::string unit(next, end);
  if (error != std::errc{} || !(value > 0) || !std::isfinite(value) ||
      (!unit.empty() && unit != "m" && unit != "km"))
    throw Error(ErrorCode::config, "--radius",
                fmt::format("expected a length above 0 such as 15m, found '{}'", text));
  return unit == "km" ? 1000 * value : value;
}

/// Corners as a user writes them on the globe.
class System {
 public:
  explicit System(const std::string& epsg) {
    if (!epsg.empty()) projection_.emplace(epsg.find(':') == epsg.npos ? "EPSG:" + epsg : epsg);
  }
  /// Latitude first, as people say it; east first in a plane system.
  Geodetic corner(double first, double second, const char* option) const {
    const bool plane = projection_ && projection_->plane();
    return plane ? xy({first, second, 0}, option) : xy({second, first, 0}, option);
  }
  /// East or longitude first.
  Geodetic xy(const Vec3& p, const char* option) const {
    if (projection_) return projection_->inverse(p);
    if (std::abs(p.y()) <= 90 && std::abs(p.x()) <= 360) return {p.y(), p.x(), 0};
    throw Error(ErrorCode::config, option,
                fmt::format("expected degrees of latitude and longitude, found {} and {}; name the "
                            "system of other coordinates with --epsg",
                            p.y(), p.x()));
  }

 private:
  std::optional<Projection> projection_;
};

/// The ways round of a box in its own system, so that its edges are straight there.
Ring box_ring(const System& system, const std::vector<double>& v) {
  constexpr int parts = 50;
  Ring ring;
  const double corners[5][2] = {
      {v[0], v[1]}, {v[2], v[1]}, {v[2], v[3]}, {v[0], v[3]}, {v[0], v[1]}};
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < parts; ++i) {
      const double s = double(i) / parts;
      ring.push_back(system.corner(corners[side][0] + s * (corners[side + 1][0] - corners[side][0]),
                                   corners[side][1] + s * (corners[side + 1][1] - corners[side][1]),
                                   "--box"));
    }
  return ring;
}

}  // namespace

Place parse_place(const PlaceOptions& o) {
  if (int(!o.at.empty()) + int(!o.box.empty()) + int(!o.polygon.empty()) != 1)
    throw Error(ErrorCode::config, "",
                "expected one place: --at LAT,LON with --radius, --box LAT,LON,LAT,LON or "
                "--polygon FILE.geojson");
  if (o.at.empty() != o.radius.empty())
    throw Error(ErrorCode::config, o.at.empty() ? "--radius" : "--at",
                "--at and --radius belong together: --at 61.2,25.1 --radius 15m");
  const System system(o.epsg);
  Place place;
  if (!o.at.empty()) {
    const auto v = numbers(o.at, 2, "--at", "LAT,LON (with --epsg of a plane system EAST,NORTH)");
    place.centre = system.corner(v[0], v[1], "--at");
    place.radius = length(o.radius);
  } else if (!o.box.empty()) {
    const auto v = numbers(o.box, 4, "--box", "two corners: LAT,LON,LAT,LON");
    if (v[0] == v[2] || v[1] == v[3])
      throw Error(ErrorCode::config, "--box", "its two corners must differ in both coordinates");
    place.rings.push_back(box_ring(system, v));
  } else {
    for (const auto& corners : geojson_rings(read_file(o.polygon), o.polygon)) {
      Ring& ring = place.rings.emplace_back();
      for (const Vec3& p : corners) ring.push_back(system.xy(p, "--polygon"));
    }
  }
  return place;
}

}  // namespace cambium::monitor
