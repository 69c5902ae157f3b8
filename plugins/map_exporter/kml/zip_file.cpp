// SPDX-License-Identifier: BSD-3-Clause
#include "zip_file.hpp"

#include <array>
#include <cstdint>

#include "cambium/error.hpp"

namespace kml {
namespace {

constexpr std::array<std::uint32_t, 256> crc_table() {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) c = c & 1 ? 0xEDB88320u ^ (c >> 1) : c >> 1;
    table[i] = c;
  }
  return table;
}

std::uint32_t crc32(const std::string& bytes) {
  static constexpr auto table = crc_table();
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char b : bytes) crc = table[(crc ^ static_cast<unsigned char>(b)) & 0xFF] ^ (crc >> 8);
  return ~crc;
}

/// Numbers lie in the file with their lowest byte first.
void put(std::string& out, std::uint32_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) out += char(value >> (8 * i) & 0xFF);
}

/// What the entry and its row in the directory have in common.
std::string description(const std::string& name, const std::string& content) {
  std::string out;
  put(out, 10, 2);       // version needed: stored files
  put(out, 1 << 11, 2);  // names are UTF-8
  put(out, 0, 2);        // stored
  put(out, 0, 2);
  put(out, 33, 2);  // 1980-01-01: the same map gives the same bytes
  put(out, crc32(content), 4);
  put(out, std::uint32_t(content.size()), 4);
  put(out, std::uint32_t(content.size()), 4);
  put(out, std::uint32_t(name.size()), 2);
  put(out, 0, 2);
  return out;
}

}  // namespace

std::string zip_of(const std::string& name, const std::string& content) {
  if (content.size() > 0xFFFF0000u)
    throw cambium::Error(cambium::ErrorCode::data, name,
                         "is larger than the 4 GB of a KMZ file; set format: kml");
  std::string out = "PK\3\4" + description(name, content) + name + content;
  const auto directory = std::uint32_t(out.size());
  out += "PK\1\2";
  put(out, 10, 2);
  out += description(name, content);
  put(out, 0, 2);  // no comment
  put(out, 0, 2);
  put(out, 0, 2);
  put(out, 0, 4);
  put(out, 0, 4);  // the entry is at the begin
  out += name;
  const auto size = std::uint32_t(out.size()) - directory;
  out += "PK\5\6";
  put(out, 0, 4);
  put(out, 1, 2);
  put(out, 1, 2);
  put(out, size, 4);
  put(out, directory, 4);
  put(out, 0, 2);
  return out;
}

}  // namespace kml
