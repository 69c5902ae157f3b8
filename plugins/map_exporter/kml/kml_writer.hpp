// SPDX-License-Identifier: BSD-3-Clause
// OGC KML 2.2, as much of it as tracks need; moving tracks are Google's extension gx:Track.
#pragma once
#include <ostream>
#include <string>

#include "cambium/atlas.hpp"

namespace kml {

/// The colours of tracks and loops, once per document.
void write_styles(std::ostream& out);

/// Writes the lines of one island.
class Writer {
 public:
  /// Keeps references: `atlas` and `georeference` must outlive it.
  Writer(std::ostream& out, const cambium::Atlas& atlas, const cambium::GeoReference& georeference,
         const std::string& altitude_mode)
      : out_(out), atlas_(atlas), georeference_(georeference), altitude_mode_(altitude_mode) {}

  void track(std::uint32_t mission);
  /// The nodes that have stamps, each with its time; false, and nothing written, below two.
  bool moving_track(std::uint32_t mission);
  void loop(const cambium::Loop& loop);

 private:
  std::string name(cambium::NodeRef n) const;
  void begin_line(const std::string& name, const std::string& style);
  void point(const cambium::Vec3& p_map);
  void end_line();

  std::ostream& out_;
  const cambium::Atlas& atlas_;
  const cambium::GeoReference& georeference_;
  const std::string& altitude_mode_;
};

}  // namespace kml
