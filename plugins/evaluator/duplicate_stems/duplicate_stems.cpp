// SPDX-License-Identifier: BSD-3-Clause
// Trees that stand twice in the fused map, because two missions put them in different places.
#include <algorithm>
#include <limits>
#include <string>

#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"
#include "stems.hpp"

namespace duplicate_stems {
namespace {

using namespace cambium;

/// What two missions share, over all pairs of missions of the map.
struct Shared {
  std::vector<double> in_map;    ///< distances of pairs that the map brings under the radius [m]
  std::vector<double> by_truth;  ///< distances in the map of the same trees [m]
};

Metric count(const char* name, std::size_t value, Better better) {
  return {std::string("duplicate_stems.") + name, double(value), "trees", better};
}

std::size_t beyond(const std::vector<double>& distances, double limit) {
  return std::size_t(
      std::count_if(distances.begin(), distances.end(), [&](double d) { return d > limit; }));
}

}  // namespace

class DuplicateStems final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("radius", radius_, "Trees of two missions nearer than this are the same one", above(0, "m"));
    v("merge_distance", merge_distance_, "Up to here an inventory takes two stems for one",
      above(0, "m"));
    v("min_sightings", min_sightings_, "A tree of a mission was detected so often",
      between(1, 1e6));
    v("only_reconstructed", only_reconstructed_, "Leave out detections without a stem model");
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }
  std::string check_params() const override {
    return merge_distance_ < radius_ ? "" : "merge_distance must be below radius";
  }

  bool needs_truth() const override { return false; }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    std::vector<std::vector<Detection>> found;
    std::size_t total = 0;
    for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
      found.push_back(detections({atlas, m}, truth, only_reconstructed_, context));
      total += found.back().size();
    }
    if (total == 0) context.warn("duplicate_stems: no node has a tree table with usable trees");
    const Shared shared = {distances(atlas, found, By::map, context),
                           distances(atlas, found, By::truth, context)};
    return metrics(shared, truth.matched > 0);
  }

 private:
  /// Distances in the map of the pairs that `by` tells to be one tree; infinite where the missions
  /// are in different islands.
  std::vector<double> distances(const Atlas& atlas,
                                const std::vector<std::vector<Detection>>& found, By by,
                                const Context& context) const {
    std::vector<std::vector<Stem>> maps;
    for (const auto& detections : found)
      maps.push_back(stems(detections, by, radius_, min_sightings_));
    std::vector<double> out;
    for (std::size_t b = 1; b < maps.size(); ++b)
      for (std::size_t a = 0; a < b; ++a) {
        context.check_cancelled();
        const bool tied = atlas.missions[a].island == atlas.missions[b].island;
        if (!tied && by == By::map) continue;  // in frames that say nothing of each other
        for (const Pair& pair : shared(maps[a], maps[b], by, radius_))
          out.push_back(tied ? pair.distance(By::map) : std::numeric_limits<double>::infinity());
      }
    return out;
  }

  std::vector<Metric> metrics(const Shared& shared, bool with_truth) const {
    // By the truth where it is known: only it sees trees that the map puts more than radius apart.
    const auto& pairs = with_truth ? shared.by_truth : shared.in_map;
    std::vector<Metric> out = {count("count", beyond(pairs, merge_distance_), Better::lower),
                               count("pairs", shared.in_map.size(), Better::neither)};
    if (!shared.in_map.empty())
      out.push_back({"duplicate_stems.rms", rms(shared.in_map), "m", Better::lower});
    if (!with_truth) return out;
    out.push_back(count("matched", shared.by_truth.size(), Better::neither));
    out.push_back(count("matched.missed", beyond(shared.by_truth, radius_), Better::lower));
    std::vector<double> tied = shared.by_truth;
    std::erase(tied, std::numeric_limits<double>::infinity());
    if (!tied.empty())
      out.push_back({"duplicate_stems.matched.rms", rms(tied), "m", Better::lower});
    return out;
  }

  double radius_ = 0.5;
  double merge_distance_ = 0.2;
  int min_sightings_ = 3;
  bool only_reconstructed_ = true;
  double max_time_difference_ = 0.01;
};

}  // namespace duplicate_stems

CAMBIUM_PLUGIN("duplicate_stems", "0.1.0") {
  registry.add<duplicate_stems::DuplicateStems>(
      "duplicate_stems", "Trees that two missions put in different places; better with truth");
}
