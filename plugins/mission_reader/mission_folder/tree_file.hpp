// SPDX-License-Identifier: BSD-3-Clause
// The trees that one node saw: x,y,z,axis_x,axis_y,axis_z,dbh,score,reconstructed.
#pragma once
#include <filesystem>
#include <vector>

#include "cambium/payload.hpp"

namespace cambium {

/// x, y, z are required; an empty dbh becomes NaN, a missing score 1. Throws Error(data,
/// file:line).
std::vector<Tree> load_trees(const std::filesystem::path& path);

}  // namespace cambium
