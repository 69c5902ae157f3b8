// SPDX-License-Identifier: BSD-3-Clause
// Results on disk under the digest of everything they depend on. Re-running is resuming.
#pragma once
#include <filesystem>
#include <functional>
#include <optional>

#include "cambium/digest.hpp"
#include "engine/cache_entry.hpp"

namespace cambium {

/// Safe for several threads, and for several processes on one folder: an entry appears whole or not
/// at all, and one that somebody removes is only computed again.
class Cache {
 public:
  using Warn = std::function<void(const std::string&)>;

  /// No folder: nothing is kept. Creates the folder when it is absent. `warn` hears of damage.
  explicit Cache(std::optional<std::filesystem::path> folder, Warn warn = {});

  /// The entry, or nothing when it is absent or damaged (then it is removed).
  std::optional<CacheEntry> get(const Digest& key) const;

  /// Throws Error(data) when the disk is full.
  void put(const Digest& key, const CacheEntry& entry) const;

  const std::optional<std::filesystem::path>& folder() const { return folder_; }

 private:
  std::filesystem::path file(const Digest& key) const;
  std::optional<std::filesystem::path> folder_;
  Warn warn_;
};

/// $CAMBIUM_CACHE, else $XDG_CACHE_HOME/cambium, else ~/.cache/cambium.
std::filesystem::path default_cache_folder();

}  // namespace cambium
