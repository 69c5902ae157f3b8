// SPDX-License-Identifier: BSD-3-Clause
// How far apart the ground of two missions lies where both saw it. Needs no truth.
#include <cmath>
#include <string>

#include "cambium/ground.hpp"
#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"

namespace ground_separation {
namespace {

using namespace cambium;

/// Heights of b's ground above a's [m], one for each cell that both know.
std::vector<double> differences(const Ground& a, const Ground& b) {
  std::vector<double> out;
  for (const auto& [cell, p] : b.cells())
    if (a.cells().contains(cell))
      if (const auto z = a.height(cell, p.x(), p.y())) out.push_back(p.z() - *z);
  return out;
}

class GroundSeparation final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("cell_size", options_.cell_size, "Width of the cells that hold one height each",
      above(0, "m"));
    v("max_range", options_.max_range, "Points farther from their node are not used",
      above(0, "m"));
    v("thickness", options_.thickness, "Points so close above the lowest in a cell are ground",
      above(0, "m"));
    v("min_points", options_.min_points, "Points of a scan that a cell needs", between(1, 1e6));
  }

  bool needs_truth() const override { return false; }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path&,
                               const Context& context) const override {
    std::vector<double> all;
    std::vector<Metric> by_missions;
    for (const Island& island : atlas.islands) {
      if (island.missions.size() < 2) continue;
      std::vector<Ground> grounds;
      for (const std::uint32_t m : island.missions)
        grounds.emplace_back(atlas, std::vector{m}, options_, context);
      for (std::size_t b = 1; b < grounds.size(); ++b)
        for (std::size_t a = 0; a < b; ++a) {
          context.check_cancelled();
          const auto between = differences(grounds[a], grounds[b]);
          if (between.empty()) continue;
          const auto name = [&](std::size_t i) {
            return atlas.missions[island.missions[i]].mission->name;
          };
          by_missions.push_back({"ground_separation." + name(a) + "." + name(b) + ".rms",
                                 rms(between), "m", Better::lower});
          all.insert(all.end(), between.begin(), between.end());
        }
    }
    std::vector<Metric> metrics;
    if (!all.empty()) {
      metrics.push_back({"ground_separation.rms", rms(all), "m", Better::lower});
      for (double& d : all) d = std::abs(d);
      metrics.push_back({"ground_separation.median", median(all), "m", Better::lower});
    }
    metrics.push_back({"ground_separation.cells", double(all.size()), "cells", Better::neither});
    metrics.insert(metrics.end(), by_missions.begin(), by_missions.end());
    return metrics;
  }

 private:
  GroundOptions options_;
};

}  // namespace
}  // namespace ground_separation

CAMBIUM_PLUGIN("ground_separation", "0.1.0") {
  registry.add<ground_separation::GroundSeparation>(
      "ground_separation", "Height between the ground of two missions; no truth needed");
}
