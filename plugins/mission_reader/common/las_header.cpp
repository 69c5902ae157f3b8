// SPDX-License-Identifier: BSD-3-Clause
#include "common/las_header.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "cambium/error.hpp"
#include "common/las_crs.hpp"

namespace las {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are read as memory is");

using Path = std::filesystem::path;

/// Bytes of a record by point format; a file may append its own to them.
constexpr std::uint16_t record_sizes[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};

[[noreturn]] void refuse(const Path& path, const std::string& what) {
  throw cambium::Error(cambium::ErrorCode::data, path.string(), what);
}

template <class T>
T number_at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string first_bytes(std::istream& in, const Path& path) {
  std::string bytes(375, '\0');
  in.read(bytes.data(), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(in.gcount()));
  in.clear();
  if (bytes.size() < 227 || !bytes.starts_with("LASF"))
    refuse(path, "is no LAS file: it does not begin with 'LASF' and a header of 227 bytes or more");
  return bytes;
}

/// Of version 1.4 the 64-bit count; the old one is zero or the same.
std::uint64_t count_of(const std::string& bytes, int minor, const Path& path) {
  const std::uint64_t old = number_at<std::uint32_t>(bytes, 107);
  if (minor < 4) return old;
  if (bytes.size() < 375) refuse(path, "ends within its header");
  const auto count = number_at<std::uint64_t>(bytes, 247);
  if (old != 0 && old != count)
    refuse(path, "its header says " + std::to_string(count) + " points, and for older readers " +
                     std::to_string(old) + "; which of them is right is not known");
  return count;
}

void set_format(Header& h, const std::string& bytes, const Path& path) {
  const auto stated = std::uint8_t(bytes[104]);
  h.compressed = (stated & 0x80) != 0;
  h.format = stated & 0x3F;  // LAZ marks compression in the highest bits
  if (h.format >= std::size(record_sizes))
    refuse(path, "is of point format " + std::to_string(h.format) + ", expected 0 to 10");
  h.record = number_at<std::uint16_t>(bytes, 105);
  if (h.record < record_sizes[h.format])
    refuse(path, "has records of " + std::to_string(h.record) + " bytes, expected " +
                     std::to_string(record_sizes[h.format]) + " or more for point format " +
                     std::to_string(h.format));
}

void set_extent(Header& h, const std::string& bytes, const Path& path) {
  for (std::size_t k = 0; k < 3; ++k) {
    h.scale[k] = number_at<double>(bytes, 131 + 8 * k);
    h.offset[k] = number_at<double>(bytes, 155 + 8 * k);
    h.high[k] = number_at<double>(bytes, 179 + 16 * k);
    h.low[k] = number_at<double>(bytes, 187 + 16 * k);
    if (!(std::isfinite(h.scale[k]) && h.scale[k] > 0 && std::isfinite(h.offset[k])))
      refuse(path, "its scale or offset is no number above zero");
  }
}

void check_size(const Header& h, const Path& path) {
  const std::uint64_t size = std::filesystem::file_size(path);
  const std::uint64_t rest = h.to_points < size ? size - h.to_points : 0;
  if (h.compressed) return;  // who unpacks it sees whether all points are there
  if (h.to_points < 227 || rest / h.record < h.points)
    refuse(path, "the header promises " + std::to_string(h.points) + " points, the file holds " +
                     std::to_string(rest / h.record) + "; it is truncated or its header is wrong");
}

}  // namespace

Header read_header(const Path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) refuse(path, "cannot be opened for reading");
  const std::string bytes = first_bytes(in, path);
  const int major = bytes[24], minor = bytes[25];
  if (major != 1 || minor < 0 || minor > 4)
    refuse(path, "is of LAS version " + std::to_string(major) + "." + std::to_string(minor) +
                     ", expected 1.0 to 1.4");
  Header h;
  set_format(h, bytes, path);
  h.points = count_of(bytes, minor, path);
  h.to_points = number_at<std::uint32_t>(bytes, 96);
  h.day = number_at<std::uint16_t>(bytes, 90);
  h.year = number_at<std::uint16_t>(bytes, 92);
  set_extent(h, bytes, path);
  check_size(h, path);
  h.crs = crs_in_records(in, number_at<std::uint16_t>(bytes, 94),
                         number_at<std::uint32_t>(bytes, 100), h.to_points);
  return h;
}

}  // namespace las
