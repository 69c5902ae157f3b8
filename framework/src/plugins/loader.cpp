// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_DLL_USE_STD_FS
#include "plugins/loader.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <boost/dll/shared_library.hpp>

#include "cambium/files.hpp"
#include "plugins/elf.hpp"
#include "plugins/handshake.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;
constexpr const char* symbol_name = "cambium_plugin";

// Leaked on purpose: see PluginLoader.
const PluginDescriptor& open_library(const fs::path& path) {
  static auto& opened = *new std::vector<boost::dll::shared_library>;
  boost::dll::shared_library library;
  std::error_code failed;
  using namespace boost::dll::load_mode;
  library.load(path, rtld_now | rtld_local, failed);
  if (failed) {
    const char* reason = dlerror();
    throw Error(ErrorCode::plugin, path.string(),
                "cannot be opened: " + std::string(reason ? reason : failed.message().c_str()) +
                    "; install what is missing (`ldd` lists it), or build the plugin again");
  }
  opened.push_back(library);
  return library.get<const PluginDescriptor>(symbol_name);
}

/// What the plugin registers, stamped with where it came from.
std::vector<Registered> components_of(const PluginDescriptor& descriptor,
                                      const LoadedPlugin& plugin) {
  Registry scratch;
  const auto refuse = [&](const std::string& why) -> Error {
    return {ErrorCode::plugin, plugin.library.string(),
            "the plugin '" + plugin.name + "' failed while it registered its components: " + why +
                "; this is for the author of the plugin to mend"};
  };
  try {
    descriptor.fill(scratch);
  } catch (const std::exception& e) {
    throw refuse(e.what());
  } catch (...) {
    throw refuse("it threw something that is no std::exception");
  }
  std::vector<Registered> out;
  for (const auto& [key, component] : scratch.all()) {
    out.push_back(component);
    out.back().plugin = plugin.name;
    out.back().plugin_version = plugin.version;
    out.back().library = plugin.library.string();
    out.back().build = plugin.build;
  }
  if (out.empty()) throw refuse("it provides no component");
  return out;
}

/// Absolute, because dlopen() looks a bare name up in the system's folders.
fs::path checked_file(const fs::path& path) {
  std::error_code failed;
  if (!fs::is_regular_file(path, failed))
    throw Error(ErrorCode::plugin, path.string(), "is not a file; expected a plugin library");
  return fs::canonical(path);
}

/// Whatever is wrong with a plugin's file is wrong with a plugin, also for the exit code.
std::string read_library(const fs::path& library) try {
  return read_file(library);
} catch (const Error& e) {
  throw Error(ErrorCode::plugin, library.string(), e.message());
}

std::string checked_content(const fs::path& library) {
  std::string content = read_library(library);
  const auto descriptor = exported_data(content, symbol_name, library.string());
  if (!descriptor)
    throw Error(ErrorCode::plugin, library.string(),
                std::string("is a shared library without the symbol '") + symbol_name +
                    "'; expected a plugin: use CAMBIUM_PLUGIN(...) in one source file and build it "
                    "with cambium_add_plugin()");
  check_descriptor(*descriptor, library.string());
  return content;
}

bool is_known(const std::vector<LoadedPlugin>& plugins, const Digest& build) {
  return std::any_of(plugins.begin(), plugins.end(),
                     [&](const LoadedPlugin& p) { return p.build == build; });
}

}  // namespace

std::optional<PluginLoader::Opened> PluginLoader::open(const fs::path& path) const {
  Opened out;
  LoadedPlugin& plugin = out.plugin;
  plugin.library = checked_file(path);
  plugin.build = digest_bytes(checked_content(plugin.library));
  if (is_known(plugins_, plugin.build)) return std::nullopt;
  const PluginDescriptor& descriptor = open_library(plugin.library);
  if (!descriptor.name || !descriptor.version || !descriptor.fill)
    throw Error(
        ErrorCode::plugin, plugin.library.string(),
        "its descriptor lacks a name, a version or its fill function; use CAMBIUM_PLUGIN()");
  plugin.name = descriptor.name;
  plugin.version = descriptor.version;
  out.components = components_of(descriptor, plugin);
  return out;
}

void PluginLoader::add(Opened opened) {
  Registry merged = registry_;  // a copy, so that a duplicate half-way leaves nothing behind
  for (auto& component : opened.components) merged.add(std::move(component));
  registry_ = std::move(merged);
  plugins_.push_back(std::move(opened.plugin));
}

void PluginLoader::load_file(const fs::path& path) {
  if (auto opened = open(path)) add(std::move(*opened));
}

void PluginLoader::load_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(folder, failed))
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  if (failed)
    throw Error(ErrorCode::plugin, folder.string(),
                "cannot be listed (" + failed.message() + "); expected a folder of plugins");
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    std::optional<Opened> opened;
    try {
      opened = open(file);
    } catch (const Error& e) {
      refusals_.push_back(e);
    }
    if (opened) add(std::move(*opened));
  }
}

void PluginLoader::load(const std::vector<fs::path>& entries) {
  for (const fs::path& entry : entries)
    fs::is_directory(entry) ? load_folder(entry) : load_file(entry);
}

}  // namespace cambium
