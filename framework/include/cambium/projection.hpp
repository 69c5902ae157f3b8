// SPDX-License-Identifier: BSD-3-Clause
// From the globe to a coordinate reference system and back, through PROJ.
#pragma once
#include <memory>
#include <string>

#include "cambium/geodesy.hpp"

namespace cambium {

/// One thread at a time.
class Projection {
 public:
  /// `crs` is anything that PROJ knows: "EPSG:32635", "EPSG:32635+5773" with heights above a geoid.
  /// Without a vertical part heights stay above the ellipsoid. Throws Error(config) when PROJ does
  /// not know it, when it is neither projected nor geographic, or when there is no exact way to it
  /// (a geoid grid that is not installed).
  explicit Projection(const std::string& crs);
  ~Projection();

  /// East (or longitude), north (or latitude), height. Throws Error(numeric) outside of the system.
  Vec3 operator()(const Geodetic& place) const;
  Geodetic inverse(const Vec3& place) const;  ///< of the operator above; throws Error(numeric)

  const std::string& crs() const { return crs_; }          ///< as it was asked for
  const std::string& name() const { return name_; }        ///< of the system
  const std::string& heights() const { return heights_; }  ///< "ellipsoidal", or the geoid's name
  bool plane() const { return plane_; }                    ///< metres east and north; else degrees
  void require_plane() const;  ///< throws Error(config) for one in degrees
  /// Well-known text of the first version (OGC 01-009), as LAS files hold it; of the plane system
  /// alone where heights are ellipsoidal, which that version cannot say.
  std::string wkt() const;

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string crs_, name_, heights_ = "ellipsoidal";
  bool plane_ = true;
};

/// The zone of Universal Transverse Mercator at a place: "EPSG:32635" (north), "EPSG:32719"
/// (south).
std::string utm_zone(double latitude, double longitude);

}  // namespace cambium
