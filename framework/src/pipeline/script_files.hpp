// SPDX-License-Identifier: BSD-3-Clause
// What a script consists of.
#pragma once
#include <filesystem>
#include <vector>

#include "cambium/digest.hpp"

namespace cambium {

/// The script, and behind it, by name, the files beside it that it may import: those with its
/// extension whose stem occurs as a word in it, or in one of these files. A name that occurs in a
/// comment only is counted, too; nothing that is imported by its name is missed. Throws Error(data)
/// when the script cannot be read.
std::vector<std::filesystem::path> script_files(const std::filesystem::path& script);

/// Of the contents of script_files() and the names of those beside the script; not of where they
/// lie. Throws Error(data).
Digest digest_script(const std::filesystem::path& script);

}  // namespace cambium
