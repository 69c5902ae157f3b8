// SPDX-License-Identifier: BSD-3-Clause
// Digests of the inputs of work items: the parts of their cache keys.
#pragma once
#include "cambium/atlas.hpp"

namespace cambium {

Digest payloads_key(const Atlas& atlas, std::size_t mission);  ///< of all payloads of a mission
Digest payload_key(const Atlas& atlas, NodeRef node);          ///< zero when it has none
Digest poses_key(const std::vector<SE3>& poses);

/// Of each part by its name: missions, payloads, poses, loops, islands.
std::vector<std::pair<std::string, Digest>> atlas_key_parts(const Atlas& atlas);

Digest atlas_key(const Atlas& atlas);  ///< of all parts together

/// Of what earlier optimisations left: only an export can look back at it.
Digest stages_key(const Atlas& atlas);

}  // namespace cambium
