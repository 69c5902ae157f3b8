// SPDX-License-Identifier: BSD-3-Clause
// How well the scans of different passes agree: needs no truth, and is finer than most of it.
#include <algorithm>
#include <cmath>

#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"
#include "overlaps.hpp"
#include "surface.hpp"

namespace map_crispness {
namespace {

using namespace cambium;

/// Agreement of two scans: NaN where nothing could be compared.
struct Agreement {
  double fused = std::nan(""), truth = std::nan("");  // median point-to-plane distance [m]
  double overlap = 0;  // share of the source's points that found a plane under the fused poses
};

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

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> out;
  std::copy_if(values.begin(), values.end(), std::back_inserter(out),
               [](double v) { return std::isfinite(v); });
  return out;
}

std::vector<Metric> metrics_of(const std::vector<Agreement>& agreements) {
  std::vector<double> fused, beside_truth, truth;
  double overlap = 0;
  for (const Agreement& a : agreements) {
    fused.push_back(a.fused);
    overlap += a.overlap / double(agreements.size());
    if (!std::isfinite(a.fused) || !std::isfinite(a.truth)) continue;
    beside_truth.push_back(a.fused);
    truth.push_back(a.truth);
  }
  fused = finite(fused);
  std::vector<Metric> out = {
      {"map_crispness.pairs", double(fused.size()), "pairs", Better::neither}};
  if (agreements.empty()) return out;
  out.push_back({"map_crispness.overlap", overlap, "", Better::higher});
  if (fused.empty()) return out;
  out.insert(out.begin(), {"map_crispness.median", median(fused), "m", Better::lower});
  out.push_back(
      {"map_crispness.worst", *std::max_element(fused.begin(), fused.end()), "m", Better::lower});
  if (truth.empty() || !(median(truth) > 0)) return out;
  out.push_back({"map_crispness.truth.median", median(truth), "m", Better::neither});
  out.push_back({"map_crispness.ratio", median(beside_truth) / median(truth), "", Better::lower});
  return out;
}

}  // namespace

class MapCrispness final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("voxel_size", voxel_size_, "One point of each voxel of a scan is compared", above(0, "m"));
    v("radius", radius_, "A point is compared when another scan has a point so close",
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
    std::vector<Agreement> agreements(pairs.size());
    context.parallel_for(groups.size(), [&](std::size_t g) {
      const auto target = atlas.payload(pairs[groups[g].first].first).cloud;
      if (!target) return;
      Surface surface(*target);
      for (std::size_t i = groups[g].first; i < groups[g].second; ++i) {
        context.check_cancelled();
        agreements[i] = compare(atlas, truth, surface, pairs[i].first, pairs[i].second);
      }
    });
    return metrics_of(agreements);
  }

 private:
  Agreement compare(const Atlas& atlas, const Truth& truth, Surface& surface, NodeRef target,
                    NodeRef source) const {
    Agreement out;
    const auto cloud = atlas.payload(source).cloud;
    if (!cloud || cloud->empty()) return out;
    const Cloud points = thinned(*cloud, voxel_size_);
    const auto fused = surface.distances(
        points, atlas.T_map_node(target).inverse() * atlas.T_map_node(source), radius_);
    out.fused = median(fused);
    out.overlap = points.empty() ? 0 : double(fused.size()) / double(points.size());
    const auto &T_world_target = truth.at(target), &T_world_source = truth.at(source);
    if (T_world_target && T_world_source)
      out.truth =
          median(surface.distances(points, T_world_target->inverse() * *T_world_source, radius_));
    return out;
  }

  double voxel_size_ = 0.5;
  double radius_ = 1.0;
  double max_distance_ = 5.0;
  double min_path_ = 20.0;
  int max_pairs_ = 200;
  double max_time_difference_ = 0.01;
};

}  // namespace map_crispness

CAMBIUM_PLUGIN("map_crispness", "0.1.0") {
  registry.add<map_crispness::MapCrispness>(
      "map_crispness", "Point-to-plane distance between overlapping scans; no truth needed");
}
