// SPDX-License-Identifier: BSD-3-Clause
#include "engine/frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cambium/path.hpp"
#include "cambium/pose_graph.hpp"
#include "engine/averaging.hpp"

namespace cambium {
namespace {

// How far missions are from rigid: what odometry may drift over the path between two ties.
constexpr double tolerance_base = 1.0;       // [m]
constexpr double tolerance_per_path = 0.02;  // [m/m]
// A loop whose information cannot see the contradiction (a height that it does not know) stays.
constexpr double visible_sigmas = 10;

using IslandPair = std::pair<std::uint32_t, std::uint32_t>;  // first < second

struct Between {
  std::vector<Tie> ties;
  std::vector<std::size_t> loops;  // into atlas.loops
};

/// The stretch of each island's paths that loops to other islands lie on [m].
class Spans {
 public:
  explicit Spans(const Atlas& atlas) : atlas_(atlas) {}
  void add(NodeRef n) {
    const auto [it, fresh] = of_mission_.try_emplace(n.mission, n.node, n.node);
    if (fresh) return;
    it->second.first = std::min(it->second.first, n.node);
    it->second.second = std::max(it->second.second, n.node);
  }
  std::vector<double> of_islands() const {
    std::vector<double> out(atlas_.islands.size(), 0.0);
    for (const auto& [m, nodes] : of_mission_) {
      const auto path = travelled(*atlas_.missions[m].mission);
      double& span = out[atlas_.missions[m].island];
      span = std::max(span, path[nodes.second] - path[nodes.first]);
    }
    return out;
  }

 private:
  const Atlas& atlas_;
  std::map<std::uint32_t, std::pair<std::uint32_t, std::uint32_t>> of_mission_;
};

std::map<IslandPair, Between> collect_ties(const Atlas& atlas, Spans& spans) {
  std::map<IslandPair, Between> out;
  for (std::size_t i = 0; i < atlas.loops.size(); ++i) {
    const Loop& loop = atlas.loops[i];
    if (loop.state != LoopState::accepted) continue;
    const auto a = atlas.missions[loop.tail.mission].island;
    const auto b = atlas.missions[loop.head.mission].island;
    if (a == b) continue;
    const SE3 T_a_b =
        atlas.T_map_node(loop.tail) * loop.T_tail_head * atlas.T_map_node(loop.head).inverse();
    Between& between = out[std::minmax(a, b)];
    between.loops.push_back(i);
    if (a < b)
      between.ties.push_back({T_a_b, atlas.T_map_node(loop.head).t});
    else
      between.ties.push_back({T_a_b.inverse(), atlas.T_map_node(loop.tail).t});
    spans.add(loop.tail);
    spans.add(loop.head);
  }
  return out;
}

std::vector<BodyPair> fit_pairs(const std::map<IslandPair, Between>& between,
                                const std::vector<double>& spans) {
  std::vector<BodyPair> pairs;
  for (const auto& [islands, b] : between) {
    BodyPair pair{islands.first, islands.second, fit_pair(b.ties)};
    pair.tolerance =
        tolerance_base + tolerance_per_path * (spans[islands.first] + spans[islands.second]);
    // Neighbouring loops share their errors: a hundred of them are not worth a hundred.
    pair.weight = std::sqrt(double(pair.fit.agreeing));
    pairs.push_back(pair);
  }
  return pairs;
}

std::string names(const Atlas& atlas, std::uint32_t island) {
  const auto& missions = atlas.islands[island].missions;
  return fmt::format("'{}'{}", atlas.missions[missions.front()].mission->name,
                     missions.size() > 1 ? " and those tied to it" : "");
}

/// Whether the loop, by its own information, sees that it is unfulfilled.
bool sees_it(const Loop& loop, const SE3& T_tail, const SE3& T_head) {
  const Vec6 r = residual(loop.T_tail_head, T_tail, T_head);
  return r.dot(loop.information * r) > visible_sigmas * visible_sigmas;
}

void reject_contradictions(Atlas& atlas, const std::vector<BodyPair>& pairs,
                           const std::map<IslandPair, Between>& between, const BodyFrames& frames,
                           const std::function<void(const std::string&)>& warn) {
  for (const BodyPair& pair : pairs) {
    if (pair.used) continue;
    const std::string what = fmt::format(
        "contradicts the frames that all other loops give by {:.1f} m; missions "
        "bend by {:.1f} m at most",
        pair.off, pair.tolerance);
    std::size_t rejected = 0;
    for (const std::size_t i : between.at({pair.first, pair.second}).loops) {
      Loop& loop = atlas.loops[i];
      const auto placed = [&](NodeRef n) {
        return frames.T_root_body[atlas.missions[n.mission].island] * atlas.T_map_node(n);
      };
      if (!sees_it(loop, placed(loop.tail), placed(loop.head))) continue;
      loop.state = LoopState::rejected;
      loop.decided_by = "optimize";
      loop.reason = what;
      ++rejected;
    }
    warn(
        fmt::format("the {} loops between {} and {}: what they say together {}; {} of them are "
                    "rejected",
                    between.at({pair.first, pair.second}).loops.size(), names(atlas, pair.first),
                    names(atlas, pair.second), what, rejected));
  }
}

Atlas placed(Atlas atlas, const BodyFrames& frames) {
  std::map<std::uint32_t, std::uint32_t> number;  // root island -> new island
  std::vector<Island> islands;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    MissionState& state = atlas.missions[m];
    const std::uint32_t body = state.island, root_body = frames.root[body];
    const auto [it, fresh] = number.emplace(root_body, std::uint32_t(islands.size()));
    // The georeference stays with the frame it was made for, and so do positions.
    const Island& root = atlas.islands[root_body];
    if (fresh) islands.push_back({{}, root.georeference, root.positions});
    islands[it->second].missions.push_back(m);
    state.island = it->second;
    if (body == root_body) continue;
    auto poses = *state.T_map_node;
    for (SE3& T : poses) T = frames.T_root_body[body] * T;
    state.T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
  }
  atlas.islands = std::move(islands);
  return atlas;
}

}  // namespace

Atlas join_islands(Atlas atlas, const std::function<void(const std::string&)>& warn) {
  Spans spans(atlas);
  const auto between = collect_ties(atlas, spans);
  auto pairs = fit_pairs(between, spans.of_islands());
  const BodyFrames frames = average_frames(atlas.islands.size(), pairs);
  reject_contradictions(atlas, pairs, between, frames, warn);
  return placed(std::move(atlas), frames);
}

}  // namespace cambium
