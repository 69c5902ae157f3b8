// SPDX-License-Identifier: BSD-3-Clause
#include "las_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace las {
namespace {

constexpr std::size_t buffered = 1 << 18;         // [bytes]
constexpr std::uint8_t only_return = 1 | 1 << 4;  // number 1 of 1

template <class T>
void append(std::string& out, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  out.append(raw, sizeof value);
}

}  // namespace

LasFile::LasFile(const std::filesystem::path& path, Header header)
    : file_(path), header_(std::move(header)) {
  file_.stream() << header_.bytes();
}

bool LasFile::add(const Point& point) {
  std::int32_t stored[3];
  for (int k = 0; k < 3; ++k) {
    const double steps = std::round((point.p[k] - header_.offset[k]) / scale);
    if (!(std::abs(steps) < 2147483647.0)) return false;  // true for NaN
    stored[k] = std::int32_t(steps);
  }
  for (int k = 0; k < 3; ++k) {
    header_.low[k] = std::min(header_.low[k], stored[k]);
    header_.high[k] = std::max(header_.high[k], stored[k]);
    append(buffer_, stored[k]);
  }
  append(buffer_, point.intensity);
  append(buffer_, only_return);
  append(buffer_, std::uint8_t(0));  // flags
  append(buffer_, point.classification);
  append(buffer_, std::uint8_t(0));  // user data
  append(buffer_, std::int16_t(0));  // scan angle
  append(buffer_, point.source);
  append(buffer_, point.time);
  if (header_.colours)
    for (const std::uint16_t c : point.colour) append(buffer_, c);
  ++header_.points;
  if (buffer_.size() >= buffered) flush();
  return true;
}

void LasFile::flush() {
  file_.stream().write(buffer_.data(), std::streamsize(buffer_.size()));
  buffer_.clear();
}

void LasFile::commit() {
  flush();
  file_.stream().seekp(0);
  file_.stream() << header_.bytes();
  file_.commit();
}

}  // namespace las
