// SPDX-License-Identifier: BSD-3-Clause
// Results on disk under the digest of everything they depend on. Re-running is resuming.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "cambium/digest.hpp"

namespace cambium {

class Cache {
 public:
  /// No folder: nothing is kept. Creates the folder when it is absent.
  explicit Cache(std::optional<std::filesystem::path> folder);

  /// The entry, or nothing when it is absent or damaged (then it is removed).
  std::optional<std::string> get(const Digest& key) const;

  /// Appears whole or not at all. Several processes may share the folder.
  void put(const Digest& key, std::string_view bytes) const;

  const std::optional<std::filesystem::path>& folder() const { return folder_; }

 private:
  std::filesystem::path file(const Digest& key) const;
  std::optional<std::filesystem::path> folder_;
};

/// $CAMBIUM_CACHE, else $XDG_CACHE_HOME/cambium, else ~/.cache/cambium.
std::filesystem::path default_cache_folder();

}  // namespace cambium
