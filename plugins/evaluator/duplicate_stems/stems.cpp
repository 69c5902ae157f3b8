// SPDX-License-Identifier: BSD-3-Clause
#include "stems.hpp"

#include "cambium/stems.hpp"

namespace duplicate_stems {
namespace {

using namespace cambium;

const Vec3& place(const Stem& stem, By by) { return by == By::map ? stem.p_map : stem.p_world; }

std::vector<Vec3> places(const std::vector<Stem>& stems, By by) {
  std::vector<Vec3> out;
  for (const Stem& s : stems) out.push_back(place(s, by));
  return out;
}

}  // namespace

std::vector<Detection> detections(const MissionView& mission, const Truth& truth,
                                  bool only_reconstructed, const Context& context) {
  std::vector<std::vector<Detection>> by_node(mission.size());
  context.parallel_for(mission.size(), [&](std::size_t n) {
    context.check_cancelled();
    const auto trees = mission.payload(n).trees;
    if (!trees) return;
    const auto& T_world_node = truth.at({mission.index, std::uint32_t(n)});
    for (const Tree& tree : *trees) {
      if ((only_reconstructed && !tree.reconstructed) || !tree.base.allFinite()) continue;
      Detection detection{mission.T_map_node(n) * tree.base, {}};
      if (T_world_node) detection.p_world = *T_world_node * tree.base;
      by_node[n].push_back(detection);
    }
  });
  std::vector<Detection> out;
  for (const auto& found : by_node) out.insert(out.end(), found.begin(), found.end());
  return out;
}

std::vector<Stem> stems(const std::vector<Detection>& detections, By by, double radius,
                        int min_sightings) {
  std::vector<const Detection*> known;
  std::vector<Vec3> at;
  for (const Detection& d : detections) {
    if (by == By::truth && !d.p_world) continue;
    known.push_back(&d);
    at.push_back(by == By::map ? d.p_map : *d.p_world);
  }
  std::vector<Stem> out;
  for (const auto& group : cambium::plan_groups(at, radius)) {
    if (group.size() < std::size_t(min_sightings)) continue;
    Stem stem;
    for (const std::size_t i : group) {
      ++stem.sightings;
      stem.p_map += (known[i]->p_map - stem.p_map) / stem.sightings;
      if (known[i]->p_world) stem.p_world += (*known[i]->p_world - stem.p_world) / stem.sightings;
    }
    out.push_back(stem);
  }
  return out;
}

double Pair::distance(By by) const { return (place(a, by) - place(b, by)).head<2>().norm(); }

std::vector<Pair> shared(const std::vector<Stem>& a, const std::vector<Stem>& b, By by,
                         double radius) {
  std::vector<Pair> pairs;
  for (const auto& [i, j] : cambium::mutual_nearest(places(a, by), places(b, by), radius))
    pairs.push_back({a[i], b[j]});
  return pairs;
}

}  // namespace duplicate_stems
