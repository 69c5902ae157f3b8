// SPDX-License-Identifier: BSD-3-Clause
// A LAS 1.4 file that is written before its number of points is known.
#pragma once
#include <filesystem>
#include <string>

#include "cambium/files.hpp"
#include "las_header.hpp"

namespace las {

struct Point {
  cambium::Vec3 p;  ///< in the file's system [m]
  std::uint16_t intensity = 0;
  std::uint8_t classification = 0;  ///< ASPRS class; 0 = never classified
  std::uint16_t source = 0;         ///< the mission, from 1
  double time = 0;                  ///< adjusted standard GPS time [s]
  std::uint16_t colour[3] = {0, 0, 0};
};

class LasFile {
 public:
  /// `header` without points; its offset should be near them.
  LasFile(const std::filesystem::path& path, Header header);

  /// False when the point is not finite or more than 2147 km from the offset; it is left out.
  bool add(const Point& point);
  /// Writes the header and makes the file appear. Throws Error(data).
  void commit();
  std::uint64_t size() const { return header_.points; }

 private:
  void flush();

  cambium::AtomicFile file_;
  Header header_;
  std::string buffer_;
};

}  // namespace las
