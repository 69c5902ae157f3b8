// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "engine/keys.hpp"
#include "engine/steps.hpp"

namespace cambium {
namespace {

// Applies the filter when somebody loads the payload; what is never looked at costs nothing.
class FilteredSource final : public PayloadSource {
 public:
  FilteredSource(Configured filter, std::shared_ptr<const Atlas> atlas, NodeRef node,
                 const Engine& engine, Digest key, std::uint64_t seed)
      : filter_(std::move(filter)),
        atlas_(std::move(atlas)),
        node_(node),
        engine_(engine),
        key_(key),
        seed_(seed) {}

  Payload load() const override {
    const auto context = engine_.context(key_, seed_);
    Payload out = filter_.as<PayloadFilter>().apply({*atlas_, node_.mission}, node_.node, *context);
    // Filters change clouds and trees; what else the node saw passes through.
    const Payload in = atlas_->payload(node_);
    if (!out.images) out.images = in.images;
    if (!out.imu) out.imu = in.imu;
    return out;
  }
  Digest digest() const override { return key_; }
  std::string where() const override {
    return (*atlas_->payloads)[node_.mission][node_.node]->where();
  }

 private:
  Configured filter_;
  std::shared_ptr<const Atlas> atlas_;  // with the payloads before this filter
  NodeRef node_;
  const Engine& engine_;
  Digest key_;
  std::uint64_t seed_;
};

Digest filter_input(const Atlas& atlas, NodeRef node, bool neighbours) {
  if (!neighbours) return payload_key(atlas, node);
  return Hasher()
      .add(payloads_key(atlas, node.mission))
      .add(poses_key(*atlas.missions[node.mission].T_map_node))
      .add(atlas.mission(node).digest)
      .add(std::uint64_t(node.node))
      .digest();
}

}  // namespace

Known run_filter(Known known, const StepScope& scope) {
  const auto atlas = std::make_shared<const Atlas>(known.atlas);
  auto out = std::make_shared<PayloadSources>(*atlas->payloads);
  std::size_t count = 0;
  for (std::uint32_t m = 0; m < out->size(); ++m) {
    const Configured& filter = scope.step.for_platform(atlas->missions[m].mission->platform_id);
    const bool neighbours = filter.as<PayloadFilter>().uses_neighbours();
    for (std::uint32_t n = 0; n < (*out)[m].size(); ++n) {
      auto& source = (*out)[m][n];
      if (!source) continue;
      const NodeRef node{m, n};
      const Digest key = scope.item_key(filter, filter_input(*atlas, node, neighbours));
      source = stored(
          std::make_shared<FilteredSource>(filter, atlas, node, scope.engine, key, scope.seed),
          scope.engine.store());
      ++count;
    }
  }
  known.streams[scope.step.keys.as] = out;
  scope.record.summary = fmt::format("{} payloads, when they are needed", count);
  return known;
}

}  // namespace cambium
