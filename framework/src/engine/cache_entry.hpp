// SPDX-License-Identifier: BSD-3-Clause
// One result of a work item, as it lies in a file of the cache.
#pragma once
#include <optional>
#include <string>

namespace cambium {

struct CacheEntry {
  std::string kind;    ///< what made it, such as "register gicp"; at most 255 bytes are kept
  double seconds = 0;  ///< what it cost to make; the time that every later hit saves
  std::string bytes;   ///< the result itself
};

/// Magic, digest of all that follows, kind, seconds, bytes. The digest finds what a full disk, a
/// crash or a bad sector left behind, so an entry needs no fsync: a lost one is computed again.
std::string pack(const CacheEntry& entry);

/// Nothing when the content does not fit its digest.
std::optional<CacheEntry> unpack(std::string_view file);

/// Kind and seconds, without the result, from the first `head_size` bytes of a file. Checks no
/// digest.
constexpr std::size_t head_size = 8 + 16 + 1 + 255 + 8;
std::optional<CacheEntry> unpack_head(std::string_view head);

}  // namespace cambium
