// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

/// Refuses two missions that are one recording: with loops between a mission and its copy, every
/// error of it would be confirmed. Copies are told by nodes with the same stamp and the same pose
/// to the last bit: at least two, and more than half of those of the shorter mission. Throws
/// Error(data) naming both.
void refuse_copies(const std::vector<Mission>& missions);

}  // namespace cambium
