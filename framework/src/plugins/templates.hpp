// SPDX-License-Identifier: BSD-3-Clause
// What `cambium plugins new` writes.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "cambium/kinds.hpp"

namespace cambium {

/// The files of framework/templates by name. `my_method`, `MyMethod` and `my_kind` in them stand for
/// the names of the new plugin, its class, and its kind.
const std::map<std::string, std::string>& plugin_templates();

enum class Language { cpp, python };

/// Writes the folder of a new plugin and returns its files. Throws Error(config) when the name is
/// none ([a-z][a-z0-9_]*), the folder holds something, or the kind is not for that language.
std::vector<std::filesystem::path> write_new_plugin(Kind kind, Language language,
                                                    const std::string& name,
                                                    const std::filesystem::path& folder);

}  // namespace cambium
