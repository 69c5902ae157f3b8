// SPDX-License-Identifier: BSD-3-Clause
// Keeps the points between two heights. Replace apply() by your method; what to keep to:
// docs/write-a-plugin.md.
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("lowest", lowest_, "Points below this height of the base frame are dropped", in_unit("m"));
    v("highest", highest_, "Points above this height of the base frame are dropped", in_unit("m"));
  }
  std::string check_params() const override {
    return lowest_ < highest_ ? "" : "lowest must be below highest";
  }

  Payload apply(const MissionView& mission, std::size_t node, const Context&) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    std::vector<std::size_t> kept;
    for (std::size_t i = 0; i < payload.cloud->size(); ++i) {
      const float z = payload.cloud->xyz[3 * i + 2];
      if (z >= lowest_ && z <= highest_) kept.push_back(i);  // false for NaN
    }
    payload.cloud = std::make_shared<const Cloud>(select(*payload.cloud, kept));
    return payload;
  }

 private:
  double lowest_ = -5.0, highest_ = 30.0;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Keeps the points between two heights");
}
