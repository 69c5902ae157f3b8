// SPDX-License-Identifier: BSD-3-Clause
// Absolute trajectory error (Sturm et al., "A benchmark for the evaluation of RGB-D SLAM systems",
// 2012): distances between estimated and true positions after one alignment.
#include <algorithm>
#include <string>

#include "cambium/fit.hpp"
#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"
#include "cambium/truth.hpp"

namespace {

using namespace cambium;

/// Estimated and true positions of the same nodes.
struct Positions {
  std::vector<Vec3> p_map, p_world;

  void add(const Positions& other) {
    p_map.insert(p_map.end(), other.p_map.begin(), other.p_map.end());
    p_world.insert(p_world.end(), other.p_world.begin(), other.p_world.end());
  }
  std::size_t size() const { return p_map.size(); }
};

std::vector<double> errors(const Positions& positions, const SE3& T_world_map) {
  std::vector<double> out;
  for (std::size_t i = 0; i < positions.size(); ++i)
    out.push_back((T_world_map * positions.p_map[i] - positions.p_world[i]).norm());
  return out;
}

Positions matched_positions(const Atlas& atlas, const Truth& truth, std::uint32_t mission) {
  Positions out;
  for (std::uint32_t n = 0; n < atlas.missions[mission].mission->nodes.size(); ++n) {
    const auto& T_world_node = truth.at({mission, n});
    if (!T_world_node) continue;
    out.p_map.push_back(atlas.T_map_node({mission, n}).t);
    out.p_world.push_back(T_world_node->t);
  }
  return out;
}

Metric metres(const std::string& name, double value) {
  return {"ate." + name, value, "m", Better::lower};
}

class AbsoluteTrajectoryError final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("alignment", alignment_, "What is free between map and truth before positions are compared",
      one_of({"yaw", "se3", "none"}));
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    truth.require_matches();
    std::vector<Positions> missions, islands(atlas.islands.size());
    for (std::uint32_t m = 0; m < atlas.missions.size(); ++m) {
      context.check_cancelled();
      missions.push_back(matched_positions(atlas, truth, m));
      islands[atlas.missions[m].island].add(missions.back());
      if (missions.back().size() == 0)
        context.warn(atlas.missions[m].mission->name + " is not judged: no true poses in " +
                     truth.files[m]);
    }
    const std::size_t map = largest(islands);
    std::vector<SE3> T_world_map;
    for (const Positions& island : islands) T_world_map.push_back(align(island));

    std::vector<Metric> metrics = summary(islands, map, T_world_map[map]);
    for (std::size_t i = 0; i < islands.size(); ++i)
      if (i != map && islands[i].size() > 0)
        metrics.push_back(metres("island_" + std::to_string(i) + ".rmse",
                                 rms(errors(islands[i], T_world_map[i]))));
    for (std::uint32_t m = 0; m < missions.size(); ++m)
      judge_mission(atlas.missions[m], missions[m], T_world_map, metrics);
    return metrics;
  }

 private:
  SE3 align(const Positions& positions) const {
    if (alignment_ == "none" || positions.size() == 0) return {};
    return alignment_ == "yaw" ? fit_yaw(positions.p_world, positions.p_map)
                               : fit_rigid(positions.p_world, positions.p_map);
  }

  /// The island with most true poses is the map; the first of equals.
  static std::size_t largest(const std::vector<Positions>& islands) {
    return std::size_t(std::max_element(islands.begin(), islands.end(),
                                        [](const Positions& a, const Positions& b) {
                                          return a.size() < b.size();
                                        }) -
                       islands.begin());
  }

  /// The nodes left outside are counted: a map must not look better for having lost a mission.
  static std::vector<Metric> summary(const std::vector<Positions>& islands, std::size_t map,
                                     const SE3& T_world_map) {
    const auto e = errors(islands[map], T_world_map);
    std::size_t all = 0;
    for (const Positions& island : islands) all += island.size();
    return {metres("rmse", rms(e)),
            metres("median", median(e)),
            metres("max", *std::max_element(e.begin(), e.end())),
            {"ate.nodes", double(e.size()), "nodes", Better::higher},
            {"ate.nodes_outside", double(all - e.size()), "nodes", Better::lower},
            {"ate.islands", double(islands.size()), "islands", Better::lower}};
  }

  void judge_mission(const MissionState& state, const Positions& positions,
                     const std::vector<SE3>& T_world_map, std::vector<Metric>& metrics) const {
    if (positions.size() == 0) return;
    const std::string& name = state.mission->name;
    metrics.push_back(metres(name + ".rmse", rms(errors(positions, T_world_map[state.island]))));
    // One or two positions fit any truth.
    if (positions.size() >= 3)
      metrics.push_back(metres(name + ".own.rmse", rms(errors(positions, align(positions)))));
  }

  std::string alignment_ = "yaw";
  double max_time_difference_ = 0.01;
};

}  // namespace

CAMBIUM_PLUGIN("ate", "0.1.0") {
  registry.add<AbsoluteTrajectoryError>(
      "ate", "Absolute trajectory error, one alignment for all missions of an island");
}
