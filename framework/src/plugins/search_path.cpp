// SPDX-License-Identifier: BSD-3-Clause
#define BOOST_DLL_USE_STD_FS
#include "plugins/search_path.hpp"

#include <algorithm>
#include <boost/dll/runtime_symbol_info.hpp>
#include <cstdlib>
#include <sstream>

#include "cambium/error.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

void append(std::vector<fs::path>& out, const fs::path& entry) {
  const fs::path path = fs::canonical(entry);
  if (std::find(out.begin(), out.end(), path) == out.end()) out.push_back(path);
}

}  // namespace

std::vector<fs::path> plugin_search_path(const std::vector<std::string>& named,
                                         const std::string& variable, const fs::path& program) {
  std::vector<fs::path> out;
  for (const std::string& entry : named) {
    if (!fs::exists(entry))
      throw Error(ErrorCode::config, entry,
                  "does not exist; --plugin-path expects a folder of "
                  "plugins or one plugin library");
    append(out, entry);
  }
  std::istringstream entries(variable);
  for (std::string entry; std::getline(entries, entry, ':');) {
    if (entry.empty()) continue;  // shells take this for the current folder
    if (!fs::path(entry).is_absolute() || !fs::exists(entry))
      throw Error(ErrorCode::config, "CAMBIUM_PLUGIN_PATH",
                  "holds '" + entry + "'; expected absolute paths that exist, separated by colons");
    append(out, entry);
  }
  // lib/ in a build tree; an installation may use lib64/ or Debian's lib/<triplet>/.
  for (const char* lib : {"lib", CAMBIUM_LIBDIR}) {
    const fs::path folder = program.parent_path() / ".." / lib / CAMBIUM_PLUGIN_SUBDIR;
    if (fs::is_directory(folder)) append(out, folder);
  }
  return out;
}

std::vector<fs::path> plugin_search_path(const std::vector<std::string>& named) {
  const char* variable = std::getenv("CAMBIUM_PLUGIN_PATH");
  return plugin_search_path(named, variable ? variable : "", boost::dll::program_location());
}

}  // namespace cambium
