// SPDX-License-Identifier: BSD-3-Clause
// The names under which AtomicFile writes, and what a killed process leaves of them.
#pragma once
#include <filesystem>

namespace cambium {

/// Beside `path`, unique in this process and among those that live; keeps the extension, because
/// some writers choose the format by it.
std::filesystem::path temporary_name(const std::filesystem::path& path);

bool is_temporary(const std::filesystem::path& path);

/// Removes, below `folder`, the temporary files of processes of this machine that live no more.
void remove_orphans(const std::filesystem::path& folder);

}  // namespace cambium
