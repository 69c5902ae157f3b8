// SPDX-License-Identifier: BSD-3-Clause
// How well missions lie to each other: relative pose errors between nodes of two missions that
// truly saw the same place.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "cambium/plugin.hpp"
#include "cambium/truth.hpp"
#include "common/relative_error.hpp"

namespace {

using namespace cambium;

struct Place {
  Vec3 p_world;
  NodeRef node;
};

using NodePair = std::pair<NodeRef, NodeRef>;

/// Pairs of nodes of two missions at most `max_distance` apart, in a fixed order. A sweep along x:
/// the cost grows with the pairs that are near, not with all pairs.
std::vector<NodePair> near_pairs(const Truth& truth, double max_distance, const Context& context) {
  std::vector<Place> places;
  for (std::uint32_t m = 0; m < truth.T_world_node.size(); ++m)
    for (std::uint32_t n = 0; n < truth.T_world_node[m].size(); ++n)
      if (const auto& T = truth.at({m, n})) places.push_back({T->t, {m, n}});
  std::stable_sort(places.begin(), places.end(),
                   [](const Place& a, const Place& b) { return a.p_world.x() < b.p_world.x(); });
  std::vector<NodePair> pairs;
  for (auto a = places.begin(); a != places.end(); ++a) {
    context.check_cancelled();
    for (auto b = a + 1; b != places.end() && b->p_world.x() - a->p_world.x() <= max_distance; ++b)
      if (a->node.mission != b->node.mission && (a->p_world - b->p_world).norm() <= max_distance)
        pairs.push_back(std::minmax(a->node, b->node));
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

using Errors = evaluator::RelativeErrors;  // [m, deg]

void report(const std::string& name, const Errors& errors, std::vector<Metric>& metrics) {
  evaluator::report("inter_mission." + name, errors, "m", "deg", metrics);
}

class InterMission final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("max_distance", max_distance_, "Nodes truly so close saw the same place", above(0, "m"));
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    truth.require_matches();
    Errors all;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Errors> by_missions;
    std::size_t untied = 0;
    for (const auto& [a, b] : near_pairs(truth, max_distance_, context)) {
      if (atlas.missions[a.mission].island != atlas.missions[b.mission].island) {
        ++untied;
        continue;
      }
      const auto error =
          evaluator::relative_error(truth.at(a)->inverse() * *truth.at(b),
                                    atlas.T_map_node(a).inverse() * atlas.T_map_node(b));
      for (Errors* sum : {&all, &by_missions[{a.mission, b.mission}]}) {
        sum->translation.push_back(error.translation);
        sum->rotation.push_back(error.rotation);
      }
    }
    std::vector<Metric> metrics;
    report("", all, metrics);
    metrics.push_back(
        {"inter_mission.pairs", double(all.rotation.size()), "pairs", Better::neither});
    // A map must not look better for having lost a mission.
    metrics.push_back({"inter_mission.untied_pairs", double(untied), "pairs", Better::lower});
    const auto name = [&](std::uint32_t m) { return atlas.missions[m].mission->name + "."; };
    for (const auto& [missions, errors] : by_missions)
      report(name(missions.first) + name(missions.second), errors, metrics);
    return metrics;
  }

 private:
  double max_distance_ = 10;
  double max_time_difference_ = 0.01;
};

}  // namespace

CAMBIUM_PLUGIN("inter_mission", "0.1.0") {
  registry.add<InterMission>("inter_mission",
                             "Relative pose error between nodes of two missions at one place");
}
