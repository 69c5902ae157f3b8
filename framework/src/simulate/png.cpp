// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/camera.hpp"

namespace cambium::simulate {
namespace {

std::uint32_t crc_of(std::string_view bytes) {  // RFC 2083, appendix 15
  std::uint32_t crc = 0xFFFFFFFFu;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xEDB88320u ^ (crc >> 1) : crc >> 1;
  }
  return ~crc;
}

std::uint32_t adler_of(std::string_view bytes) {  // RFC 1950
  std::uint32_t a = 1, b = 0;
  for (const char c : bytes) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  return b << 16 | a;
}

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out.push_back(char(value >> shift & 255));
  return out;
}

std::string chunk(const std::string& type, const std::string& data) {
  return big_endian(std::uint32_t(data.size())) + type + data + big_endian(crc_of(type + data));
}

std::string stored(const std::string& raw) {
  constexpr std::size_t most = 65535;
  std::string out = "\x78\x01";
  for (std::size_t at = 0; at < raw.size(); at += most) {
    const std::string block = raw.substr(at, most);
    out.push_back(at + most >= raw.size() ? 1 : 0);
    for (const std::size_t length : {block.size(), ~block.size()})
      out += {char(length & 255), char(length >> 8 & 255)};
    out += block;
  }
  return out + big_endian(adler_of(raw));
}

}  // namespace

std::string png_of(const Picture& picture) {
  std::string raw;
  for (int row = 0; row < picture.rows; ++row)
    raw += std::string(1, '\0') +  // no filter
           picture.grey.substr(std::size_t(row * picture.columns), std::size_t(picture.columns));
  const std::string grey_8_bits("\x08\x00\x00\x00\x00", 5);
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", big_endian(std::uint32_t(picture.columns)) +
                           big_endian(std::uint32_t(picture.rows)) + grey_8_bits) +
         chunk("IDAT", stored(raw)) + chunk("IEND", "");
}

}  // namespace cambium::simulate
