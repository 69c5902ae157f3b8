// SPDX-License-Identifier: BSD-3-Clause
// Pairwise consistency maximisation (PCM): of the loops between two missions, the largest set that
// agree with each other through both odometries. See README.md.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "cambium/plugin.hpp"
#include "verdicts.hpp"

namespace cambium::pcm {
namespace {

class PairwiseConsistency final : public LoopVerifier {
 public:
  void params(ParamVisitor& v) override {
    v("probability", probability_, "Share of pairs of correct loops that pass the consistency test",
      between(0.5, 0.999999));
    v("min_clique", min_clique_,
      "Fewer loops that agree with each other do not tie two missions; within a mission the "
      "odometry counts as one",
      between(1, 1000));
    v("min_support_path", min_support_path_,
      "The loops that tie two missions must span this much of both paths", at_least(0.0, "m"));
    v("max_rival", max_rival_,
      "No tie when loops over the same path that contradict the largest set agree among themselves "
      "and are more than this share of it",
      between(0, 1));
    v("drift", drift_.systematic.translation,
      "Sigma of the odometry's systematic drift, per metre of path", at_least(0.0, "m/m"));
    v("drift_rotation", drift_.systematic.rotation,
      "Sigma of the odometry's systematic turn, per metre of path", at_least(0.0, "rad/m"));
    v("step_bound", drift_.bound.translation,
      "Largest sigma that one step of the odometry may claim, per metre; used where it has no edge",
      above(0.0, "m/m"));
    v("step_bound_rotation", drift_.bound.rotation, "The same for the turn of one step",
      above(0.0, "rad/m"));
    v("loop_sigma", loop_.translation, "Added to what the registration claims", above(0.0, "m"));
    v("loop_sigma_rotation", loop_.rotation, "Added to what the registration claims",
      above(0.0, "rad"));
    v("branch_limit", branch_limit_,
      "Branches of the clique search before it takes the best so far", between(1, 1e9));
  }

  std::vector<Verdict> verify(const Atlas& atlas, std::span<const std::size_t> loops,
                              const Context& context) const override {
    std::map<std::uint32_t, Path> paths;
    for (const std::size_t i : loops)
      for (const NodeRef n : {atlas.loops[i].tail, atlas.loops[i].head})
        if (!paths.contains(n.mission))
          paths.emplace(n.mission, Path(*atlas.missions[n.mission].mission, drift_));

    const Rules rules{chi_square_6(probability_), std::size_t(min_clique_), min_support_path_,
                      max_rival_, std::size_t(branch_limit_)};
    std::vector<Verdict> verdicts(loops.size());
    for (const auto& [missions, members] : by_pair(atlas, loops)) {
      const auto pair = pair_of(atlas, loops, members, paths);
      const auto judged = judge(pair, rules, context);
      for (std::size_t k = 0; k < members.size(); ++k) verdicts[members[k]] = judged[k];
    }
    return verdicts;
  }

 private:
  using Groups = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>>;

  /// Positions in `loops` by pair of missions, in an order that does not depend on that of `loops`.
  static Groups by_pair(const Atlas& atlas, std::span<const std::size_t> loops) {
    Groups groups;
    for (std::size_t k = 0; k < loops.size(); ++k) {
      const Loop& loop = atlas.loops[loops[k]];
      groups[{loop.tail.mission, loop.head.mission}].push_back(k);
    }
    const auto key = [&](std::size_t k) {
      const Loop& l = atlas.loops[loops[k]];
      const Vec3& t = l.T_tail_head.t;  // one pair of nodes may have been registered twice
      return std::tuple(l.tail, l.head, t.x(), t.y(), t.z(), loops[k]);
    };
    for (auto& [missions, members] : groups)
      std::sort(members.begin(), members.end(),
                [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
    return groups;
  }

  PairOfMissions pair_of(const Atlas& atlas, std::span<const std::size_t> loops,
                         const std::vector<std::size_t>& members,
                         const std::map<std::uint32_t, Path>& paths) const {
    const Loop& first = atlas.loops[loops[members.front()]];
    PairOfMissions pair;
    pair.tail_name = atlas.mission(first.tail).name;
    pair.head_name = atlas.mission(first.head).name;
    pair.tails = &paths.at(first.tail.mission);
    pair.heads = &paths.at(first.head.mission);
    pair.within = first.tail.mission == first.head.mission;
    for (const std::size_t k : members) {
      const Loop& l = atlas.loops[loops[k]];
      pair.loops.push_back({l.T_tail_head,
                            covariance_of(l.T_tail_head, l.information) + diagonal(loop_),
                            l.tail.node, l.head.node});
      pair.labels.push_back(fmt::format("{}-{}", atlas.node(l.tail).id, atlas.node(l.head).id));
    }
    return pair;
  }

  double probability_ = 0.99;
  int min_clique_ = 3;
  double min_support_path_ = 5.0;
  double max_rival_ = 0.5;
  Drift drift_{{0.01, 0.0003}, {0.05, 0.005}};
  Sigma loop_{0.1, 0.01};
  std::int64_t branch_limit_ = 1000000;
};

}  // namespace
}  // namespace cambium::pcm

CAMBIUM_PLUGIN("pairwise_consistency", "0.1.0") {
  registry.add<cambium::pcm::PairwiseConsistency>(
      "pairwise_consistency",
      "Keeps the largest set of loops that agree with each other and the odometry (PCM)");
}
