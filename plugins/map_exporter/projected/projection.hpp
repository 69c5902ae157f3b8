// SPDX-License-Identifier: BSD-3-Clause
// From a map to a coordinate reference system, through PROJ.
#pragma once
#include <memory>
#include <string>

#include "cambium/geodesy.hpp"

namespace projected {

/// One thread at a time.
class Projection {
 public:
  /// `crs` is anything that PROJ knows: "EPSG:32635", "EPSG:32635+5773" with heights above a geoid.
  /// Without a vertical part heights stay above the ellipsoid. Throws Error(config) when PROJ does
  /// not know it, when it is not a projected one, or when there is no exact way to it (a geoid grid
  /// that is not installed).
  explicit Projection(const std::string& crs);
  ~Projection();

  /// East (or longitude), north (or latitude), height. Throws Error(numeric) outside of the system.
  cambium::Vec3 operator()(const cambium::Geodetic& place) const;

  const std::string& crs() const { return crs_; }          ///< as it was asked for
  const std::string& name() const { return name_; }        ///< of the system
  const std::string& heights() const { return heights_; }  ///< "ellipsoidal", or the geoid's name

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string crs_, name_, heights_ = "ellipsoidal";
};

}  // namespace projected
