// SPDX-License-Identifier: BSD-3-Clause
#include "conformance/world.hpp"

#include <functional>
#include <limits>

#include "simulate/recording.hpp"
#include "simulate/sensor.hpp"
#include "simulate/tree_table.hpp"

namespace cambium::conformance {
namespace {

using namespace cambium::simulate;

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

SimulationSpec forest() {
  SimulationSpec spec;
  spec.seed = 7;
  spec.stand.size = {70, 60};
  spec.stand.density = 700;
  for (const char* name : {"a", "b"}) {
    MissionSpec m;
    m.name = name;
    m.path.size = {26, 16};
    m.path.spacing = 3;
    m.path.offset = name == std::string("a") ? 0 : 1;
    m.sensor.beams = 16;
    m.sensor.columns = 360;
    m.sensor.max_range = 35;
    m.trees.enabled = true;
    m.gnss.enabled = true;
    m.gnss.sigma = 0.5;
    m.gnss.correlation_time = 5;
    spec.missions.push_back(m);
  }
  return spec;
}

struct Ground {
  SimulationSpec spec = forest();
  Terrain terrain = make_terrain(spec.terrain, spec.stand.size, std::uint64_t(spec.seed));
  std::vector<Stem> stems = plant(spec.stand, terrain, std::uint64_t(spec.seed));
  Foliage leaves = grow(spec.foliage, spec.stand, terrain, stems, std::uint64_t(spec.seed));
  Scene scene{terrain, stems, {}, leaves};
};

Payload look(const Ground& g, const Recording& r, std::size_t i) {
  const SE3& T_world_base = r.truth[i].T_world_base;
  const Lidar lidar(r.spec.sensor);
  return {
      std::make_shared<const Cloud>(lidar.scan(g.scene, T_world_base, Random(r.seed, "scan", i))),
      std::make_shared<const std::vector<Tree>>(
          detect(r.spec.trees, T_world_base, r.stems, {}, g.terrain, Random(r.seed, "trees", i))
              .trees)};
}

MissionState state_of(const Mission& mission, const std::vector<SE3>& T_world_node,
                      std::uint32_t index) {
  MissionState state;
  state.mission = std::make_shared<const Mission>(mission);
  std::vector<SE3> poses;
  for (const SE3& T : T_world_node) poses.push_back(T);
  state.T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  state.id_offset = NodeId(index) * 10000;
  return state;
}

// True loops between nodes that are near, as a good registration would find them.
std::vector<Loop> loops_of(const World& world) {
  std::vector<Loop> loops;
  const auto& T = world.T_world_node;
  for (std::uint32_t i = 0; i < T[0].size(); ++i)
    for (std::uint32_t k = 0; k < T[1].size(); ++k) {
      if ((T[0][i].t - T[1][k].t).norm() > 4) continue;
      Loop loop;
      loop.tail = {0, i};
      loop.head = {1, k};
      loop.state = LoopState::accepted;
      loop.T_tail_head = world.T_target_source(loop.tail, loop.head);
      loop.information = Mat6::Identity() * 400;
      loop.proposed_by = loop.registered_by = loop.decided_by = "conformance";
      loops.push_back(loop);
    }
  return loops;
}

}  // namespace

SE3 World::T_target_source(NodeRef target, NodeRef source) const {
  return T_world_node[target.mission][target.node].inverse() *
         T_world_node[source.mission][source.node];
}

World make_world() {
  const Ground ground;
  World world;
  PayloadSources payloads;
  for (std::uint32_t m = 0; m < 2; ++m) {
    Recording r = record(ground.spec, m, ground.terrain, ground.stems, {});
    r.mission.digest = Hasher().add("conformance").add(r.mission.name).digest();
    world.T_world_node.emplace_back();
    payloads.emplace_back();
    for (std::size_t i = 0; i < r.truth.size(); ++i) {
      world.T_world_node[m].push_back(r.truth[i].T_world_base);
      const Digest digest = Hasher().add(r.mission.name).add(std::uint64_t(i)).digest();
      payloads[m].push_back(std::make_shared<const InMemory>(look(ground, r, i), digest));
      r.mission.nodes[i].payload = payloads[m].back();
    }
    world.atlas.missions.push_back(state_of(r.mission, world.T_world_node[m], m));
  }
  world.atlas.islands = {{{0, 1}, std::nullopt}};
  world.atlas.payloads = std::make_shared<const PayloadSources>(std::move(payloads));
  world.atlas.loops = loops_of(world);
  return world;
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
      sources[m].push_back(
          std::make_shared<const InMemory>(payload({m, i}, atlas.payload({m, i})), digest));
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
