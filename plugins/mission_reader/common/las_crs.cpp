// SPDX-License-Identifier: BSD-3-Clause
#include "common/las_crs.hpp"

#include <algorithm>
#include <cstring>

#include "common/las_header.hpp"

namespace las {
namespace {

constexpr std::size_t record_head = 54;
constexpr std::uint16_t text_record = 2112, key_record = 34735;
// GeoTIFF keys (OGC 19-008r4): codes of EPSG where the key's place is 0.
constexpr std::uint16_t geographic_key = 2048, projected_key = 3072, vertical_key = 4096;
constexpr std::uint16_t user_defined = 32767;

std::uint16_t word_at(const std::string& bytes, std::size_t offset) {
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string codes_of(const std::string& keys) {
  std::uint16_t plane = 0, geographic = 0, vertical = 0;
  for (std::size_t at = 8; at + 8 <= keys.size(); at += 8) {
    const std::uint16_t key = word_at(keys, at), place = word_at(keys, at + 2);
    const std::uint16_t code = word_at(keys, at + 6);
    if (place != 0 || code == user_defined) continue;
    if (key == projected_key) plane = code;
    if (key == geographic_key) geographic = code;
    if (key == vertical_key) vertical = code;
  }
  const std::uint16_t code = plane ? plane : geographic;
  if (code == 0) return {};
  std::string out = "EPSG:" + std::to_string(code);
  if (vertical) out.append(1, '+').append(std::to_string(vertical));
  return out;
}

}  // namespace

std::string crs_in_records(std::istream& in, std::uint64_t begin, std::uint32_t count,
                           std::uint64_t end) {
  std::string text, keys;
  for (std::uint32_t i = 0; i < count && begin + record_head <= end; ++i) {
    std::string head(record_head, '\0');
    in.clear();
    in.seekg(std::streamoff(begin));
    if (!in.read(head.data(), std::streamsize(head.size()))) break;
    const std::uint16_t id = word_at(head, 18), size = word_at(head, 20);
    begin += record_head;
    if (begin + size > end) break;
    const bool ours = std::string(head.c_str() + 2).starts_with("LASF_Projection");
    if (ours && (id == text_record || id == key_record)) {
      std::string content(size, '\0');
      if (!in.read(content.data(), size)) break;
      (id == text_record ? text : keys) = content;
    }
    begin += size;
  }
  text.resize(std::strlen(text.c_str()));  // it ends with zeros
  if (text.find('[') != text.npos) return text;
  return codes_of(keys);
}

std::string horizontal_part(const std::string& crs) {
  if (crs.starts_with("EPSG:")) return crs.substr(0, crs.find('+'));
  if (!crs.starts_with("COMPOUNDCRS") && !crs.starts_with("COMPD_CS")) return crs;
  std::size_t begin = crs.npos;
  for (const char* word : {"PROJCRS[", "PROJCS[", "GEOGCRS[", "GEOGCS["}) {
    const auto at = crs.find(word);
    if (at != crs.npos) begin = std::min(begin, at);
  }
  if (begin == crs.npos) return crs;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = begin; i < crs.size(); ++i) {
    if (crs[i] == '"') quoted = !quoted;
    if (quoted) continue;
    depth += crs[i] == '[';
    depth -= crs[i] == ']';
    if (crs[i] == ']' && depth == 0) return crs.substr(begin, i + 1 - begin);
  }
  return crs;
}

}  // namespace las
