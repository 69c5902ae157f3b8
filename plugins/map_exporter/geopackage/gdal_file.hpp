// SPDX-License-Identifier: BSD-3-Clause
// A GeoPackage (OGC 12-128) through GDAL, which is seen in gdal_file.cpp only.
#pragma once
#include <filesystem>
#include <memory>
#include <string>

#include "cambium/files.hpp"
#include "common/features.hpp"

namespace geopackage {

/// Where the coordinates of a layer are.
struct System {
  std::string crs;    ///< as PROJ names it; empty: a frame of its own
  std::string frame;  ///< the name of that frame
};

class File {
 public:
  /// `written` is the time that the file states, so that the same map gives the same bytes.
  File(const std::filesystem::path& path, const cambium::Stamp& written);
  ~File();

  /// Adds a layer under `name`; its features come one by one, with their points in `system`.
  /// Throws Error(config) when GDAL does not know the system, Error(data) when writing fails.
  void begin_layer(const std::string& name, const cambium::map_export::Layer& layer,
                   const System& system, const std::string& description);
  void add(const cambium::map_export::Layer& layer, const std::vector<cambium::Vec3>& points,
           const std::vector<cambium::map_export::Value>& values);

  /// Makes the file appear. Throws Error(data).
  void commit();

 private:
  struct Handles;
  void check(bool done, const char* what);

  std::filesystem::path path_;
  cambium::AtomicFile file_;
  std::unique_ptr<Handles> handles_;
};

}  // namespace geopackage
