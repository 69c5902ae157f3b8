// SPDX-License-Identifier: BSD-3-Clause
// How well the scans of different passes agree: needs no truth, and is finer than most of it.
#include "cambium/plugin.hpp"
#include "overlaps.hpp"
#include "summary.hpp"

namespace map_crispness {
namespace {

using namespace cambium;

using Pairs = std::vector<std::pair<NodeRef, NodeRef>>;

/// Runs of pairs with one target: its surface is prepared once.
std::vector<std::pair<std::size_t, std::size_t>> by_target(const Pairs& pairs) {
  std::vector<std::pair<std::size_t, std::size_t>> groups;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i == 0 || pairs[i].first != pairs[i - 1].first) groups.emplace_back(i, i);
    groups.back().second = i + 1;
  }
  return groups;
}

Surface surface_of(const Cloud& cloud, const SE3& T_map_node) {
  return Surface(cloud, T_map_node.q.conjugate() * Vec3::UnitZ());
}

}  // namespace

class MapCrispness final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("voxel_size", voxel_size_, "One point of each voxel of a scan is compared", above(0, "m"));
    v("radius", reach_.contact, "A point is compared when another scan has a point so close",
      above(0, "m"));
    v("entropy_radius", reach_.entropy, "Neighbourhoods of this radius give the map entropy",
      above(0, "m"));
    v("max_distance", max_distance_, "Scans are compared when taken so close together",
      above(0, "m"));
    v("min_path", min_path_, "And, within a mission, so far apart along the path", above(0, "m"));
    v("max_pairs", max_pairs_, "More pairs of scans than this are thinned evenly", between(1, 1e6));
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }

  bool needs_truth() const override { return false; }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    const Pairs pairs = overlapping_pairs(
        atlas, truth, {max_distance_, min_path_, std::size_t(max_pairs_)}, context);
    const auto groups = by_target(pairs);
    std::vector<Compared> compared(pairs.size());
    context.parallel_for(groups.size(), [&](std::size_t g) {
      const NodeRef node = pairs[groups[g].first].first;
      const auto cloud = atlas.payload(node).cloud;
      if (!cloud) return;
      Surface target = surface_of(*cloud, atlas.T_map_node(node));
      for (std::size_t i = groups[g].first; i < groups[g].second; ++i) {
        context.check_cancelled();
        compared[i] = compare(atlas, truth, target, pairs[i].first, pairs[i].second);
      }
    });
    return summary(compared);
  }

 private:
  Compared compare(const Atlas& atlas, const Truth& truth, Surface& target, NodeRef target_node,
                   NodeRef source_node) const {
    Compared out;
    const auto cloud = atlas.payload(source_node).cloud;
    if (!cloud || cloud->empty()) return out;
    const Cloud points = thinned(*cloud, voxel_size_);
    Surface source = surface_of(*cloud, atlas.T_map_node(source_node));
    const auto under = [&](const SE3& T_frame_target, const SE3& T_frame_source) {
      return agreement(target, source, points, T_frame_target.inverse() * T_frame_source, reach_);
    };
    out.fused = under(atlas.T_map_node(target_node), atlas.T_map_node(source_node));
    const auto &T_world_target = truth.at(target_node), &T_world_source = truth.at(source_node);
    if (T_world_target && T_world_source) out.truth = under(*T_world_target, *T_world_source);
    return out;
  }

  double voxel_size_ = 0.5;
  Reach reach_ = {1.0, 0.5};
  double max_distance_ = 5.0;
  double min_path_ = 20.0;
  int max_pairs_ = 200;
  double max_time_difference_ = 0.01;
};

}  // namespace map_crispness

CAMBIUM_PLUGIN("map_crispness", "0.2.0") {
  registry.add<map_crispness::MapCrispness>(
      "map_crispness",
      "Point-to-plane distance and entropy of overlapping scans on ground and stems");
}
