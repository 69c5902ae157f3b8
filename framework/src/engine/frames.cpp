// SPDX-License-Identifier: BSD-3-Clause
#include "engine/frames.hpp"

#include <algorithm>
#include <map>

namespace cambium {
namespace {

using IslandPair = std::pair<std::uint32_t, std::uint32_t>;  // first < second

// A loop as it looks between two rigid bodies: T_first_second, and where it acts in `second`.
struct Tie {
  SE3 T_first_second;
  Vec3 p_second;
};

// How far the hypothesis moves the place where the tie acts [m]; angles act through the lever arm
// of the other ties, so positions are enough.
double disagreement(const SE3& hypothesis, const Tie& tie) {
  return (hypothesis * tie.p_second - tie.T_first_second * tie.p_second).norm();
}

double median_disagreement(const SE3& hypothesis, const std::vector<Tie>& ties) {
  std::vector<double> d;
  for (const Tie& t : ties) d.push_back(disagreement(hypothesis, t));
  std::nth_element(d.begin(), d.begin() + std::ptrdiff_t(d.size() / 2), d.end());
  return d[d.size() / 2];
}

// Least median of squares over the ties themselves (Rousseeuw 1984): right with up to half of them
// wrong. At most 200 hypotheses, evenly spread.
SE3 agreed_transform(const std::vector<Tie>& ties) {
  const std::size_t step = std::max<std::size_t>(1, ties.size() / 200);
  SE3 best = ties.front().T_first_second;
  double best_median = median_disagreement(best, ties);
  for (std::size_t i = step; i < ties.size(); i += step) {
    const double m = median_disagreement(ties[i].T_first_second, ties);
    if (m < best_median) best = ties[i].T_first_second, best_median = m;
  }
  return best;
}

std::map<IslandPair, std::vector<Tie>> collect_ties(const Atlas& atlas) {
  std::map<IslandPair, std::vector<Tie>> ties;
  for (const Loop& loop : atlas.loops) {
    if (loop.state != LoopState::accepted) continue;
    const auto a = atlas.missions[loop.tail.mission].island;
    const auto b = atlas.missions[loop.head.mission].island;
    if (a == b) continue;
    const SE3 T_a_b =
        atlas.T_map_node(loop.tail) * loop.T_tail_head * atlas.T_map_node(loop.head).inverse();
    if (a < b)
      ties[{a, b}].push_back({T_a_b, atlas.T_map_node(loop.head).t});
    else
      ties[{b, a}].push_back({T_a_b.inverse(), atlas.T_map_node(loop.tail).t});
  }
  return ties;
}

struct Body {
  bool placed = false;
  std::uint32_t root = 0;
  SE3 T_root_body;
};

// Grows each tree from its first island, always along the pair with the most loops.
std::vector<Body> place_bodies(std::size_t count,
                               const std::map<IslandPair, std::vector<Tie>>& ties) {
  std::vector<Body> bodies(count);
  for (std::uint32_t root = 0; root < count; ++root) {
    if (bodies[root].placed) continue;
    bodies[root] = {true, root, SE3{}};
    for (;;) {
      const std::vector<Tie>* best = nullptr;
      IslandPair pair{};
      for (const auto& [p, t] : ties) {
        const bool reaches = (bodies[p.first].placed && bodies[p.first].root == root) !=
                             (bodies[p.second].placed && bodies[p.second].root == root);
        if (reaches && (!best || t.size() > best->size())) best = &t, pair = p;
      }
      if (!best) break;
      const SE3 T_first_second = agreed_transform(*best);
      if (bodies[pair.first].placed)
        bodies[pair.second] = {true, root, bodies[pair.first].T_root_body * T_first_second};
      else
        bodies[pair.first] = {true, root,
                              bodies[pair.second].T_root_body * T_first_second.inverse()};
    }
  }
  return bodies;
}

}  // namespace

Atlas join_islands(Atlas atlas) {
  const auto bodies = place_bodies(atlas.islands.size(), collect_ties(atlas));
  std::map<std::uint32_t, std::uint32_t> number;  // root island -> new island
  std::vector<Island> islands;
  for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
    MissionState& state = atlas.missions[m];
    const Body& body = bodies[state.island];
    const auto [it, fresh] = number.emplace(body.root, std::uint32_t(islands.size()));
    // The georeference stays with the frame it was made for, and so do positions.
    const Island& root = atlas.islands[body.root];
    if (fresh) islands.push_back({{}, root.georeference, root.positions});
    islands[it->second].missions.push_back(m);
    auto poses = *state.T_map_node;
    for (SE3& T : poses) T = body.T_root_body * T;
    state.T_map_node = std::make_shared<const std::vector<SE3>>(std::move(poses));
    state.island = it->second;
  }
  atlas.islands = std::move(islands);
  return atlas;
}

}  // namespace cambium
