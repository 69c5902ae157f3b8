// SPDX-License-Identifier: BSD-3-Clause
// From the coordinates of LAS files to the mission's frame.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cambium/projection.hpp"

namespace las_tiles {

/// Where the mission's frame lies in the files' coordinates.
struct Frame {
  std::string crs;                               ///< empty: the files' own axes, moved to `origin`
  cambium::Vec3 origin = cambium::Vec3::Zero();  ///< in the files' coordinates
};

/// Maps points of the files into the mission's frame: east, north, up at the origin, metres. Every
/// point by itself: a grid is turned, stretched and curved against that frame. One thread at a
/// time.
class ToMission {
 public:
  explicit ToMission(const Frame& frame);
  cambium::Vec3 operator()(const cambium::Vec3& p_file) const;
  /// Of the frame; nothing without a coordinate reference system.
  std::optional<cambium::GeoReference> georeference() const;

 private:
  Frame frame_;
  std::optional<cambium::Projection> projection_;
  cambium::Geodetic reference_;
};

/// A system in which PROJ finds `place`: `crs`, or its plane part with a warning that heights are
/// taken as they are. Throws Error(data, file) when PROJ does not know it.
std::string usable_crs(const std::string& crs, const cambium::Vec3& place, const std::string& file,
                       std::vector<std::string>& warnings);

}  // namespace las_tiles
