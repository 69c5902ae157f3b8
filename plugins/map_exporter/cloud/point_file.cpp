// SPDX-License-Identifier: BSD-3-Clause
// PLY: G. Turk, "The PLY polygon file format", 1994. PCD: the Point Cloud Library's format 0.7.
#include "point_file.hpp"

#include <bit>

namespace cloud {
namespace {

static_assert(std::endian::native == std::endian::little, "both formats are written as memory is");

constexpr std::size_t header_size = 512;
constexpr std::size_t buffered_floats = 1 << 16;

/// A comment that fills the header up to a fixed size, so that it can be written last.
std::string padding(std::size_t used, const std::string& start) {
  return start + std::string(header_size - used - start.size() - 1, '.') + "\n";
}

std::string ply_header(std::size_t size, bool with_intensity) {
  const std::string top = "ply\nformat binary_little_endian 1.0\n";
  std::string fields = "element vertex " + std::to_string(size) +
                       "\nproperty float x\nproperty float y\nproperty float z\n";
  if (with_intensity) fields += "property float intensity\n";
  fields += "end_header\n";
  return top + padding(top.size() + fields.size(), "comment written by Cambium ") + fields;
}

std::string pcd_header(std::size_t size, bool with_intensity) {
  const std::string count = std::to_string(size);
  std::string fields = "VERSION 0.7\n";
  fields += with_intensity ? "FIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\n"
                           : "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\n";
  fields +=
      "WIDTH " + count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
  return padding(fields.size(), "# .PCD v0.7 - written by Cambium ") + fields;
}

}  // namespace

PointFile::PointFile(const std::filesystem::path& path, Format format, bool with_intensity)
    : file_(path), format_(format), with_intensity_(with_intensity) {
  file_.stream() << header();
}

std::string PointFile::header() const {
  return format_ == Format::ply ? ply_header(size_, with_intensity_)
                                : pcd_header(size_, with_intensity_);
}

void PointFile::add(const cambium::Vec3& p_map, float intensity) {
  for (int axis = 0; axis < 3; ++axis) buffer_.push_back(float(p_map[axis]));
  if (with_intensity_) buffer_.push_back(intensity);
  ++size_;
  if (buffer_.size() >= buffered_floats) flush();
}

void PointFile::flush() {
  file_.stream().write(reinterpret_cast<const char*>(buffer_.data()),
                       std::streamsize(buffer_.size() * sizeof(float)));
  buffer_.clear();
}

void PointFile::commit() {
  flush();
  file_.stream().seekp(0);
  file_.stream() << header();
  file_.commit();
}

}  // namespace cloud
