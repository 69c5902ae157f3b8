// SPDX-License-Identifier: BSD-3-Clause
// How well the scans of different passes agree: needs no truth, and is finer than most of it.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "agreement.hpp"
#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"
#include "overlaps.hpp"

namespace map_crispness {
namespace {

using namespace cambium;

/// Two scans under the fused poses and, where they are known, under the true ones.
struct Compared {
  std::optional<Agreement> fused, truth;
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

/// A figure of the pairs that have it.
std::vector<double> finite(const std::vector<Agreement>& agreements, double Agreement::*figure) {
  std::vector<double> out;
  for (const Agreement& a : agreements)
    if (std::isfinite(a.*figure)) out.push_back(a.*figure);
  return out;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

/// Medians of distances and the mean entropy, as `<prefix>median`, ...
std::vector<Metric> summary(const std::vector<Agreement>& agreements, const std::string& prefix,
                            Better better) {
  std::vector<Metric> out;
  const auto add = [&](const char* name, double Agreement::*figure) {
    if (const auto values = finite(agreements, figure); !values.empty())
      out.push_back({"map_crispness." + prefix + name, median(values), "m", better});
  };
  add("median", &Agreement::all);
  add("ground", &Agreement::ground);
  add("upright", &Agreement::upright);
  if (const auto entropies = finite(agreements, &Agreement::entropy); !entropies.empty())
    out.push_back({"map_crispness." + prefix + "entropy", mean(entropies), "nat", better});
  return out;
}

std::vector<Metric> metrics_of(const std::vector<Compared>& compared) {
  std::vector<Agreement> fused, beside_truth, truth;
  double overlap = 0;
  for (const Compared& c : compared) {
    if (!c.fused) continue;
    fused.push_back(*c.fused);
    overlap += c.fused->overlap / double(compared.size());
    if (!c.truth || !std::isfinite(c.fused->all) || !std::isfinite(c.truth->all)) continue;
    beside_truth.push_back(*c.fused);
    truth.push_back(*c.truth);
  }
  const auto distances = finite(fused, &Agreement::all);
  std::vector<Metric> out = summary(fused, "", Better::lower);
  out.push_back({"map_crispness.pairs", double(distances.size()), "pairs", Better::neither});
  if (compared.empty()) return out;
  out.push_back({"map_crispness.overlap", overlap, "", Better::higher});
  if (distances.empty()) return out;
  out.push_back({"map_crispness.worst", *std::max_element(distances.begin(), distances.end()), "m",
                 Better::lower});
  const auto of_truth = summary(truth, "truth.", Better::neither);
  out.insert(out.end(), of_truth.begin(), of_truth.end());
  const auto true_distances = finite(truth, &Agreement::all);
  if (!true_distances.empty() && median(true_distances) > 0)
    out.push_back({"map_crispness.ratio",
                   median(finite(beside_truth, &Agreement::all)) / median(true_distances), "",
                   Better::lower});
  return out;
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
    return metrics_of(compared);
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
