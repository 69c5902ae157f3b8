// SPDX-License-Identifier: BSD-3-Clause
// Opens plugin libraries and collects what they provide.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cambium/plugin.hpp"

namespace cambium {

struct LoadedPlugin {
  std::filesystem::path library;
  std::string name, version;
  Digest build;  ///< of the library's file
};

/// Libraries are never unloaded, not even when the loader goes: components, their vtables and the
/// exceptions they threw may live longer, and libraries leave thread-local and static state behind.
class PluginLoader {
 public:
  /// Opens one plugin that the user named. All that it provides is registered, or nothing is.
  /// The same library again, under whatever path, is no error. Throws Error(plugin) naming the
  /// path, what is wrong and what to do.
  void load_file(const std::filesystem::path& path);

  /// Opens every *.so of a folder, in the order of their names. One that cannot be used is put down
  /// in `refusals` and the others go on; but two that provide the same component are an error.
  void load_folder(const std::filesystem::path& folder);

  /// Each entry is a folder or a library.
  void load(const std::vector<std::filesystem::path>& entries);

  const Registry& registry() const { return registry_; }
  const std::vector<LoadedPlugin>& plugins() const { return plugins_; }
  const std::vector<Error>& refusals() const { return refusals_; }

 private:
  struct Opened {
    LoadedPlugin plugin;
    std::vector<Registered> components;
  };
  std::optional<Opened> open(const std::filesystem::path& path) const;  ///< nothing: known already
  void add(Opened opened);

  Registry registry_;
  std::vector<LoadedPlugin> plugins_;
  std::vector<Error> refusals_;
};

}  // namespace cambium
