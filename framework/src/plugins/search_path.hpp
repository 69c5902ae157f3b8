// SPDX-License-Identifier: BSD-3-Clause
// Where plugins are looked for.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace cambium {

/// First what the user named (--plugin-path; folders or libraries), then the folders in
/// CAMBIUM_PLUGIN_PATH (absolute, separated by colons), then the folder that was installed or built
/// beside the running program. The current folder is never among them unless named: what a run does
/// must not depend on where it is started. Absolute, each once.
/// Throws Error(config) when an entry of the first two does not exist, or is relative in the
/// second.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::string>& named);

/// The same with its surroundings as arguments. `variable` is the value of CAMBIUM_PLUGIN_PATH,
/// `program` the path of the executable.
std::vector<std::filesystem::path> plugin_search_path(const std::vector<std::string>& named,
                                                      const std::string& variable,
                                                      const std::filesystem::path& program);

}  // namespace cambium
