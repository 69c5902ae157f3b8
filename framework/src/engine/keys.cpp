// SPDX-License-Identifier: BSD-3-Clause
#include "engine/keys.hpp"

#include "engine/codec.hpp"

namespace cambium {

Digest payload_key(const Atlas& atlas, NodeRef node) {
  const auto& source = (*atlas.payloads)[node.mission][node.node];
  return source ? source->digest() : Digest{};
}

Digest payloads_key(const Atlas& atlas, std::size_t mission) {
  Hasher hasher;
  for (const auto& source : (*atlas.payloads)[mission])
    hasher.add(source ? source->digest() : Digest{});
  return hasher.digest();
}

Digest poses_key(const std::vector<SE3>& poses) { return digest_bytes(encode(poses)); }

Digest atlas_key(const Atlas& atlas) {
  Hasher hasher;
  for (std::size_t m = 0; m < atlas.missions.size(); ++m) {
    const MissionState& s = atlas.missions[m];
    hasher.add(s.mission->name).add(s.mission->digest).add(poses_key(*s.T_map_node));
    hasher.add(std::uint64_t(s.island)).add(std::uint64_t(s.id_offset));
    hasher.add(payloads_key(atlas, m));
  }
  hasher.add(encode(atlas.loops));
  for (const Island& island : atlas.islands)
    hasher.add(encode(island.missions)).add(encode(island.georeference));
  return hasher.digest();
}

}  // namespace cambium
