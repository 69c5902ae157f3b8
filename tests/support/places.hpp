// SPDX-License-Identifier: BSD-3-Clause
// Where the tests find what belongs to this tree. Paths of one machine stand in places.cpp alone,
// so that a compiler cache serves every other file in every clone.
#pragma once
#include <filesystem>
#include <string>

namespace cambium::testing {

/// A file or folder of the source tree: source("docs/formats.md").
std::filesystem::path source(const std::string& relative);

/// A file or folder of the build tree: built("bin/cambium").
std::filesystem::path built(const std::string& relative);

/// Where this build puts the shipped plugins.
std::filesystem::path plugin_folder();

}  // namespace cambium::testing
