// SPDX-License-Identifier: BSD-3-Clause
// How far the fused missions bent: the largest distance between a node's place in the map and where
// its own odometry put it. Replace evaluate(); what to keep to: docs/write-a-plugin.md.
#include <algorithm>

#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("skip", skip_, "So many nodes at the start of each mission are left out", between(0, 1e6));
  }
  bool needs_truth() const override { return false; }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path&,
                               const Context& context) const override {
    std::vector<Metric> out;
    double largest = 0;
    for (const MissionState& state : atlas.missions) {
      context.check_cancelled();
      const SE3 T = T_map_mission(state);
      double bent = 0;
      for (std::size_t i = std::size_t(skip_); i < state.mission->nodes.size(); ++i)
        bent = std::max(
            bent,
            ((*state.T_map_node)[i].t - (T * state.mission->nodes[i].T_mission_node).t).norm());
      out.push_back({"my_method." + state.mission->name, bent, "m", Better::neither});
      largest = std::max(largest, bent);
    }
    out.insert(out.begin(), {"my_method.largest", largest, "m", Better::neither});
    return out;
  }

 private:
  int skip_ = 0;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "How far the fused missions bent");
}
