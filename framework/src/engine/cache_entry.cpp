// SPDX-License-Identifier: BSD-3-Clause
#include "engine/cache_entry.hpp"

#include <algorithm>
#include <cstring>

#include "cambium/digest.hpp"

namespace cambium {
namespace {

constexpr std::string_view magic = "CAMBIUM2";
constexpr std::size_t content_at = magic.size() + sizeof(Digest);
constexpr std::size_t smallest = content_at + 1 + sizeof(double);

}  // namespace

std::string pack(const CacheEntry& entry) {
  const auto length = static_cast<unsigned char>(std::min<std::size_t>(entry.kind.size(), 255));
  std::string out(content_at, '\0');
  out.reserve(smallest + length + entry.bytes.size());
  out += static_cast<char>(length);
  out.append(entry.kind, 0, length);
  out.append(reinterpret_cast<const char*>(&entry.seconds), sizeof entry.seconds);
  out += entry.bytes;
  const Digest digest = digest_bytes(std::string_view(out).substr(content_at));
  std::memcpy(out.data(), magic.data(), magic.size());
  std::memcpy(out.data() + magic.size(), &digest, sizeof digest);
  return out;
}

std::optional<CacheEntry> unpack_head(std::string_view head) {
  if (head.size() < smallest || !head.starts_with(magic)) return std::nullopt;
  head.remove_prefix(content_at);
  const auto length = static_cast<unsigned char>(head.front());
  if (head.size() < 1 + length + sizeof(double)) return std::nullopt;
  CacheEntry entry;
  entry.kind = head.substr(1, length);
  std::memcpy(&entry.seconds, head.data() + 1 + length, sizeof entry.seconds);
  return entry;
}

std::optional<CacheEntry> unpack(std::string_view file) {
  auto entry = unpack_head(file);
  if (!entry) return std::nullopt;
  Digest stored;
  std::memcpy(&stored, file.data() + magic.size(), sizeof stored);
  if (digest_bytes(file.substr(content_at)) != stored) return std::nullopt;
  entry->bytes = file.substr(smallest + entry->kind.size());
  return entry;
}

}  // namespace cambium
