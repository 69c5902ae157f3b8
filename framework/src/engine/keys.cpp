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

std::vector<std::pair<std::string, Digest>> atlas_key_parts(const Atlas& atlas) {
  Hasher missions, payloads, poses, islands;
  for (std::size_t m = 0; m < atlas.missions.size(); ++m) {
    const MissionState& s = atlas.missions[m];
    missions.add(s.mission->name).add(s.mission->digest).add(std::uint64_t(s.id_offset));
    payloads.add(payloads_key(atlas, m));
    poses.add(poses_key(*s.T_map_node));
    islands.add(std::uint64_t(s.island));
  }
  for (const Island& island : atlas.islands)
    islands.add(encode(island.missions))
        .add(encode(island.georeference))
        .add(encode(island.positions));
  return {{"missions", missions.digest()},
          {"payloads", payloads.digest()},
          {"poses", poses.digest()},
          {"loops", digest_bytes(encode(atlas.loops))},
          {"islands", islands.digest()}};
}

Digest atlas_key(const Atlas& atlas) {
  Hasher hasher;
  for (const auto& [part, digest] : atlas_key_parts(atlas)) hasher.add(digest);
  return hasher.digest();
}

Digest stages_key(const Atlas& atlas) {
  Hasher hasher;
  for (const Stage& stage : atlas.stages) {
    hasher.add(stage.step).add(encode(stage.islands));
    for (const auto& poses : stage.T_map_node) hasher.add(poses_key(*poses));
  }
  return hasher.digest();
}

}  // namespace cambium
