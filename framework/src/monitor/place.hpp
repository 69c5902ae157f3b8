// SPDX-License-Identifier: BSD-3-Clause
// A place on the globe that a user asks about, and where it lies in a map.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cambium/geodesy.hpp"

namespace cambium::monitor {

/// A closed line; the last corner is not repeated.
using Ring = std::vector<Geodetic>;

/// A circle, or polygons whose inner rings are holes.
struct Place {
  std::optional<Geodetic> centre;
  double radius = 0;        ///< around the centre [m]
  std::vector<Ring> rings;  ///< of all polygons: inside is what an odd number of them holds
};

/// Options as a user writes them; empty ones are not given.
struct PlaceOptions {
  std::string at;       ///< LAT,LON, or EAST,NORTH of a plane system
  std::string radius;   ///< "15m", "15", "0.2km"
  std::string box;      ///< two corners, each as `at`
  std::string polygon;  ///< GeoJSON file: longitude, latitude, or the coordinates of the system
  std::string epsg;     ///< code of the system that all of them are in; empty = WGS 84
};

/// Throws Error(config) when there is not exactly one place, when numbers are none, or when PROJ
/// does not know the system; Error(data) for a file that is no GeoJSON with polygons.
Place parse_place(const PlaceOptions& options);

/// The polygons of a GeoJSON text in its own coordinates, as rings of (x, y, 0). `where` names it.
std::vector<std::vector<Vec3>> geojson_rings(const std::string& text, const std::string& where);

/// A place in a map frame: z does not count.
class Region {
 public:
  /// Long edges are cut into short ones: what is straight in one system is not in another.
  Region(const Place& place, const GeoReference& georeference);

  bool contains(const Vec3& p_map) const;
  /// From the place's bounds, 0 inside of them [m].
  double distance(const Vec3& p_map) const;
  const Vec3& middle() const { return middle_; }
  Digest digest() const;  ///< of where it lies

 private:
  std::vector<std::vector<Vec3>> rings_;  // empty: a circle
  Vec3 middle_ = Vec3::Zero(), low_, high_;
  double radius_ = 0;
};

}  // namespace cambium::monitor
