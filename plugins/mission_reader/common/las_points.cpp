// SPDX-License-Identifier: BSD-3-Clause
#include "common/las_points.hpp"

#include <algorithm>
#include <fstream>
#include <memory>

#include "cambium/error.hpp"
#include "common/unpacking.hpp"

namespace las {
namespace {

constexpr std::size_t at_once = 4096;  // [points]

template <class T>
T number_at(const char* bytes) {
  T value;
  std::memcpy(&value, bytes, sizeof value);
  return value;
}

Point point_of(const char* record, const Header& h) {
  Point p;
  p.x = number_at<std::int32_t>(record) * h.scale[0] + h.offset[0];
  p.y = number_at<std::int32_t>(record + 4) * h.scale[1] + h.offset[1];
  p.z = number_at<std::int32_t>(record + 8) * h.scale[2] + h.offset[2];
  p.intensity = number_at<std::uint16_t>(record + 12);
  // Older formats have five bits for the class; the others are flags.
  p.classification = h.format < 6 ? std::uint8_t(record[15]) & 31 : std::uint8_t(record[16]);
  return p;
}

}  // namespace

void for_each_point(const std::filesystem::path& path, const Header& h,
                    const std::function<void(const Point&)>& visit) {
  std::ifstream file;
  std::unique_ptr<Unpacking> unpacking;
  if (h.compressed) {
    unpacking = std::make_unique<Unpacking>(path);
  } else {
    file.open(path, std::ios::binary);
    file.seekg(h.to_points);
  }
  std::string block;
  for (std::uint64_t done = 0; done < h.points; done += at_once) {
    block.resize(std::size_t(std::min<std::uint64_t>(at_once, h.points - done)) * h.record);
    if (unpacking)
      unpacking->read(block);
    else if (!file.read(block.data(), std::streamsize(block.size())))
      throw cambium::Error(cambium::ErrorCode::data, path.string(), "its points cannot be read");
    for (std::size_t i = 0; i < block.size(); i += h.record) visit(point_of(block.data() + i, h));
  }
}

}  // namespace las
