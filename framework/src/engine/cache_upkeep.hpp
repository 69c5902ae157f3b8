// SPDX-License-Identifier: BSD-3-Clause
// Looking after a cache folder. Everything here is safe while runs use the folder: entries are
// whole files that are only ever renamed into place or removed.
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cambium {

struct CachedFile {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  std::chrono::seconds unused{0};  ///< since its last use, to the hour
};

/// All entries, those unused for longest first. What a killed run left half-written is no entry.
std::vector<CachedFile> cached_files(const std::filesystem::path& folder);

struct CacheGroup {
  std::size_t entries = 0;
  std::uintmax_t bytes = 0;
  double seconds = 0;  ///< that making them took
  std::chrono::seconds newest{0}, oldest{0};
};

/// Reads the heads only; entries without a sound one count as "damaged".
std::map<std::string, CacheGroup> cache_by_kind(const std::filesystem::path& folder);

/// Reads every entry; removes and returns those that do not fit their digest.
std::vector<std::filesystem::path> remove_damaged(const std::filesystem::path& folder);

/// Copies the entries of another cache that this one does not have; returns how many. Damaged ones
/// are left where they are.
std::size_t adopt_entries(const std::filesystem::path& from, const std::filesystem::path& into);

struct PruneLimits {
  std::optional<std::uintmax_t> bytes;         ///< of all entries together
  std::optional<std::chrono::seconds> unused;  ///< entries unused for longer go
};
struct Pruned {
  std::size_t removed = 0, kept = 0;
  std::uintmax_t removed_bytes = 0, kept_bytes = 0;
};

/// Removes the entries unused for longest until the limits hold, and the leftovers of killed runs.
Pruned prune_cache(const std::filesystem::path& folder, const PruneLimits& limits);

}  // namespace cambium
