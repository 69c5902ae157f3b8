// SPDX-License-Identifier: BSD-3-Clause
// The same recording named twice would be tied to itself, and count as two witnesses.
#pragma once
#include <vector>

#include "engine/engine.hpp"

namespace cambium {

/// Throws Error(data) naming two missions where more than half of the nodes of one have the stamp
/// and pose of nodes of the other, to the last bit; ids, names and platforms do not matter.
void refuse_copies(const std::vector<Mission>& missions);

/// The same for what the nodes saw: more than half of the different payloads of one mission are
/// also in the other, whatever its graph says of them. Reads the payload files.
void refuse_shared_payloads(const Atlas& atlas, const Engine& engine);

}  // namespace cambium
