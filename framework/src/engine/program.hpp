// SPDX-License-Identifier: BSD-3-Clause
// The running program: its version, where it is installed, the digest of its code.
#pragma once
#include <filesystem>
#include <string>

#include "cambium/digest.hpp"

namespace cambium {

std::string program_version();
std::filesystem::path program_path();  ///< of the executable
const Digest& program_build();         ///< of the executable and libcambium, read once

}  // namespace cambium
