// SPDX-License-Identifier: BSD-3-Clause
// Where a command writes: a folder that is new, empty, or of an earlier call of the same command.
#pragma once
#include <filesystem>
#include <string>

namespace cambium {

/// Creates the folder, and clears it of what killed processes left. `mark` is a file that every
/// folder of this kind holds, `kind` its name for the user. Throws Error(config) when the folder
/// holds something else.
void open_output_folder(const std::filesystem::path& out, const std::string& mark,
                        const std::string& kind);

}  // namespace cambium
