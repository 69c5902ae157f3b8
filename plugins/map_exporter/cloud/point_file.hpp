// SPDX-License-Identifier: BSD-3-Clause
// A binary PLY or PCD file that is written before its number of points is known.
#pragma once
#include <filesystem>
#include <vector>

#include "cambium/files.hpp"
#include "cambium/se3.hpp"

namespace cloud {

class PointFile {
 public:
  enum class Format { ply, pcd };
  /// Points have x y z, and also intensity if asked for.
  PointFile(const std::filesystem::path& path, Format format, bool with_intensity);

  void add(const cambium::Vec3& p_map, float intensity);
  /// Puts the number of points into the header and makes the file appear. Throws Error(data).
  void commit();
  std::size_t size() const { return size_; }

 private:
  std::string header() const;
  void flush();

  cambium::AtomicFile file_;
  Format format_;
  bool with_intensity_;
  std::size_t size_ = 0;
  std::vector<float> buffer_;
};

}  // namespace cloud
