// SPDX-License-Identifier: BSD-3-Clause
#include "grid_cloud.hpp"

#include <bit>
#include <cstring>

namespace projected {

static_assert(std::endian::native == std::endian::little, "points are written as memory is");

GridCloud::GridCloud(const std::filesystem::path& path, std::vector<std::string> remarks)
    : file_(path), remarks_(std::move(remarks)) {
  file_.stream() << header();
}

std::string GridCloud::header() const {
  std::string count = std::to_string(size_);
  count.insert(0, 20 - count.size(), '0');  // a fixed width, so that it can be written last
  std::string out = "ply\nformat binary_little_endian 1.0\n";
  for (const std::string& remark : remarks_) out += "comment " + remark + "\n";
  return out + "element vertex " + count +
         "\nproperty double x\nproperty double y\nproperty double z\nproperty float intensity\n"
         "end_header\n";
}

void GridCloud::add(const cambium::Vec3& p, float intensity) {
  char bytes[3 * sizeof(double) + sizeof(float)];
  std::memcpy(bytes, p.data(), 3 * sizeof(double));
  std::memcpy(bytes + 3 * sizeof(double), &intensity, sizeof intensity);
  file_.stream().write(bytes, sizeof bytes);
  ++size_;
}

void GridCloud::commit() {
  file_.stream().seekp(0);
  file_.stream() << header();
  file_.commit();
}

}  // namespace projected
