// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "conformance/world.hpp"

namespace cambium::conformance {
namespace {

class InMemory final : public PayloadSource {
 public:
  InMemory(Payload payload, Digest digest) : payload_(std::move(payload)), digest_(digest) {}
  Payload load() const override { return payload_; }
  Digest digest() const override { return digest_; }
  std::string where() const override { return "the conformance kit's forest"; }

 private:
  Payload payload_;
  Digest digest_;
};

}  // namespace

std::shared_ptr<const PayloadSource> in_memory(Payload payload, Digest digest) {
  return std::make_shared<const InMemory>(std::move(payload), digest);
}

Atlas with_payloads(const Atlas& atlas,
                    const std::function<Payload(NodeRef, const Payload&)>& payload) {
  Atlas out = atlas;
  PayloadSources sources(atlas.missions.size());
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    Mission mission = *atlas.missions[m].mission;
    for (std::uint32_t i = 0; i < mission.nodes.size(); ++i) {
      const Digest digest =
          Hasher().add("other").add(std::uint64_t(m)).add(std::uint64_t(i)).digest();
      sources[m].push_back(in_memory(payload({m, i}, atlas.payload({m, i})), digest));
      mission.nodes[i].payload = sources[m].back();
    }
    out.missions[m].mission = std::make_shared<const Mission>(std::move(mission));
  }
  out.payloads = std::make_shared<const PayloadSources>(std::move(sources));
  return out;
}

Atlas first_nodes(const Atlas& atlas, std::size_t nodes) {
  Atlas out = atlas;
  PayloadSources sources = *atlas.payloads;
  for (std::size_t m = 0; m < atlas.missions.size(); ++m) {
    Mission mission = *atlas.missions[m].mission;
    mission.nodes.resize(nodes);
    std::erase_if(mission.edges, [&](const Edge& e) {
      return !mission.index_of(e.tail) || !mission.index_of(e.head);
    });
    auto poses = *atlas.missions[m].T_map_node;
    poses.resize(nodes);
    sources[m].resize(nodes);
    out.missions[m].mission = std::make_shared<const Mission>(std::move(mission));
    out.missions[m].T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  }
  std::erase_if(out.loops,
                [&](const Loop& l) { return l.tail.node >= nodes || l.head.node >= nodes; });
  out.payloads = std::make_shared<const PayloadSources>(std::move(sources));
  return out;
}

std::vector<OddPayload> odd_payloads() {
  const auto cloud = [](std::vector<float> xyz) {
    Cloud c;
    c.xyz = std::move(xyz);
    return std::make_shared<const Cloud>(std::move(c));
  };
  const auto trees = [](std::vector<Tree> list) {
    return std::make_shared<const std::vector<Tree>>(std::move(list));
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  constexpr float inf = std::numeric_limits<float>::infinity();
  const Tree stem{Vec3(1, 2, -1), Vec3::UnitZ(), 0.2, 0.5, true};
  const Tree lost{Vec3(double(nan), 0, 0), Vec3::Zero(), double(nan), 0, false};
  std::vector<float> same(3000, 1.0F), none(3000, nan);
  return {{"no payload", {}},
          {"an empty cloud and table", {cloud({}), trees({})}},
          {"three points and one tree", {cloud({0, 0, 0, 1, 0, 0, 0, 1, 0}), trees({stem})}},
          {"points and trees that are not finite",
           {cloud({nan, 0, 0, inf, 1, 2, 0, -inf, nan, 1, 2, 3}), trees({lost, stem, lost})}},
          {"a thousand points that are not numbers", {cloud(std::move(none)), trees({lost})}},
          {"a thousand points in one place", {cloud(std::move(same)), trees({stem, stem, stem})}}};
}

}  // namespace cambium::conformance
