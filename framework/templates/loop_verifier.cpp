// SPDX-License-Identifier: BSD-3-Clause
// Accepts the loops that most other loops between the same two missions agree with. Replace
// verify() by your method; what to keep to: docs/write-a-plugin.md.
#include <string>

#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public LoopVerifier {
 public:
  void params(ParamVisitor& v) override {
    v("max_distance", max_distance_, "Loops that place the missions farther apart disagree",
      above(0.0, "m"));
    v("min_share", min_share_, "So many of the others must agree", between(0, 1));
  }

  std::vector<Verdict> verify(const Atlas& atlas, std::span<const std::size_t> loops,
                              const Context& context) const override {
    std::vector<Verdict> out;
    for (const std::size_t i : loops) {
      context.check_cancelled();
      std::size_t others = 0, agreeing = 0;
      for (const std::size_t k : loops) {
        if (k == i || !same_missions(atlas.loops[i], atlas.loops[k])) continue;
        ++others;
        agreeing += contradiction(atlas, atlas.loops[i], atlas.loops[k]) < max_distance_;
      }
      const bool accepted = others > 0 && double(agreeing) >= min_share_ * double(others);
      out.push_back({accepted, "agrees with " + std::to_string(agreeing) + " of " +
                                   std::to_string(others) + " other loops"});
    }
    return out;
  }

 private:
  static bool same_missions(const Loop& a, const Loop& b) {
    return a.tail.mission == b.tail.mission && a.head.mission == b.head.mission;
  }
  // How far from home the cycle through both loops and both odometries ends [m].
  static double contradiction(const Atlas& atlas, const Loop& a, const Loop& b) {
    const auto& odometry = [&](NodeRef from, NodeRef to) {
      return atlas.node(from).T_mission_node.inverse() * atlas.node(to).T_mission_node;
    };
    const SE3 cycle = a.T_tail_head * odometry(a.head, b.head) * b.T_tail_head.inverse() *
                      odometry(b.tail, a.tail);
    return cycle.t.norm();
  }

  double max_distance_ = 2.0, min_share_ = 0.5;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Accepts loops that most others agree with");
}
