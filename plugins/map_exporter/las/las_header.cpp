// SPDX-License-Identifier: BSD-3-Clause
#include "las_header.hpp"

#include <bit>
#include <cstring>

namespace las {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as memory is");

constexpr std::uint16_t header_size = 375;
constexpr std::uint16_t adjusted_gps_time = 1, well_known_text = 16;  // of the global encoding

class Bytes {
 public:
  template <class T>
  void add(T value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    text.append(raw, sizeof value);
  }
  void add_text(const std::string& word, std::size_t size) {
    std::string field = word.substr(0, size);
    field.resize(size, '\0');
    text += field;
  }
  std::string text;
};

/// A variable length record; `content` is followed by a zero.
std::string record(const std::string& user, std::uint16_t id, const std::string& description,
                   const std::string& content) {
  Bytes b;
  b.add(std::uint16_t(0));
  b.add_text(user, 16);
  b.add(id);
  b.add(std::uint16_t(content.size() + 1));
  b.add_text(description, 32);
  return b.text + content + '\0';
}

void add_identity(Bytes& b, const Header& h, std::uint32_t to_points, std::uint32_t records) {
  b.add_text("LASF", 4);
  b.add(std::uint16_t(0));  // several sources
  // The specification asks for well-known text with these point formats, stated or not.
  b.add(std::uint16_t(adjusted_gps_time | well_known_text));
  b.add_text("", 16);  // no GUID
  b.add(std::uint8_t(1));
  b.add(std::uint8_t(4));
  b.add_text("MERGE", 32);
  b.add_text("Cambium", 32);
  b.add(std::uint16_t(h.day.day));
  b.add(std::uint16_t(h.day.year));
  b.add(header_size);
  b.add(to_points);
  b.add(records);
  b.add(std::uint8_t(h.colours ? 7 : 6));
  b.add(std::uint16_t(h.record_length()));
  b.add_text("", 24);  // the counts of older versions, zero with these point formats
}

void add_extent(Bytes& b, const Header& h) {
  for (int k = 0; k < 3; ++k) b.add(scale);
  for (int k = 0; k < 3; ++k) b.add(h.offset[k]);
  for (int k = 0; k < 3; ++k) {
    b.add(h.points ? h.high[k] * scale + h.offset[k] : 0.0);
    b.add(h.points ? h.low[k] * scale + h.offset[k] : 0.0);
  }
}

}  // namespace

std::string Header::bytes() const {
  std::string records;
  std::uint32_t count = 1;
  if (!wkt.empty()) {
    records += record("LASF_Projection", 2112, "coordinate reference system", wkt);
    ++count;
  }
  // A record holds 65535 bytes: so many names that they do not fit end early.
  records += record("Cambium", 1, "missions by point source id", missions.substr(0, 65000));
  Bytes b;
  add_identity(b, *this, std::uint32_t(header_size + records.size()), count);
  add_extent(b, *this);
  b.add(std::uint64_t(0));  // waveforms
  b.add(std::uint64_t(0));  // records behind the points
  b.add(std::uint32_t(0));
  b.add(points);
  b.add(points);  // all are first returns
  b.add_text("", 14 * sizeof(std::uint64_t));
  return b.text + records;
}

}  // namespace las
