// SPDX-License-Identifier: BSD-3-Clause
// Relative pose error over fixed distances (Sturm et al., IROS 2012; lengths as in Geiger et al.,
// "Are we ready for autonomous driving?", CVPR 2012): what drift is left inside each mission.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "cambium/plugin.hpp"
#include "cambium/truth.hpp"
#include "common/relative_error.hpp"

namespace {

using namespace cambium;

/// The nodes of a mission with a true pose, in order.
struct Track {
  std::vector<SE3> T_map_node, T_world_node;
  std::vector<double> path;  // true distance travelled at each [m]
};

Track judged_track(const MissionState& state, const std::vector<std::optional<SE3>>& truth) {
  Track out;
  for (std::size_t n = 0; n < truth.size(); ++n) {
    if (!truth[n]) continue;
    const double step = out.path.empty() ? 0 : (truth[n]->t - out.T_world_node.back().t).norm();
    out.path.push_back(out.path.empty() ? 0 : out.path.back() + step);
    out.T_map_node.push_back((*state.T_map_node)[n]);
    out.T_world_node.push_back(*truth[n]);
  }
  return out;
}

/// For node `first` the later node whose distance along the path is nearest to `delta`, the earlier
/// of equals; nothing when that is off by more than `tolerance` [m].
std::optional<std::size_t> partner(const std::vector<double>& path, std::size_t first, double delta,
                                   double tolerance) {
  const auto begin = path.begin() + std::ptrdiff_t(first) + 1;
  const auto off = [&](auto it) { return std::abs(*it - path[first] - delta); };
  auto best =
      std::partition_point(begin, path.end(), [&](double p) { return p - path[first] < delta; });
  if (best != begin && (best == path.end() || off(std::prev(best)) <= off(best)))
    best = std::lower_bound(begin, best, *std::prev(best));  // it may have stood still there
  if (best == path.end() || off(best) > tolerance) return std::nullopt;
  return std::size_t(best - path.begin());
}

using Errors = evaluator::RelativeErrors;  // each over the true path between the nodes [%, deg/m]

Errors errors_over(const Track& track, double delta, double tolerance) {
  Errors out;
  for (std::size_t i = 0; i + 1 < track.path.size(); ++i) {
    const auto j = partner(track.path, i, delta, tolerance);
    if (!j) continue;
    const auto between = [&](const std::vector<SE3>& poses) {
      return poses[i].inverse() * poses[*j];
    };
    const auto error =
        evaluator::relative_error(between(track.T_world_node), between(track.T_map_node));
    const double length = track.path[*j] - track.path[i];
    out.translation.push_back(100 * error.translation / length);
    out.rotation.push_back(error.rotation / length);
  }
  return out;
}

void report(const std::string& name, const Errors& errors, std::vector<Metric>& metrics) {
  evaluator::report("rpe." + name, errors, "%", "deg/m", metrics);
}

class RelativePoseError final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("deltas", deltas_, "Lengths of path over which poses are compared", above(0, "m"));
    v("tolerance", tolerance_, "Share of a length by which a pair of nodes may miss it",
      between(0, 0.5));
    v("max_time_difference", max_time_difference_, "Between a node and its true pose",
      at_least(0, "s"));
  }
  std::string check_params() const override {
    return deltas_.empty() ? "deltas must name at least one length" : "";
  }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path& reference,
                               const Context& context) const override {
    const Truth truth = read_truth(atlas, reference, max_time_difference_);
    truth.require_matches();
    Errors all;
    std::vector<Errors> by_delta(deltas_.size()), by_mission(atlas.missions.size());
    for (std::size_t m = 0; m < atlas.missions.size(); ++m) {
      context.check_cancelled();
      const Track track = judged_track(atlas.missions[m], truth.T_world_node[m]);
      for (std::size_t d = 0; d < deltas_.size(); ++d) {
        const Errors errors = errors_over(track, deltas_[d], tolerance_ * deltas_[d]);
        for (Errors* sum : {&all, &by_delta[d], &by_mission[m]}) sum->add(errors);
      }
    }
    std::vector<Metric> metrics;
    report("", all, metrics);
    metrics.push_back({"rpe.pairs", double(all.rotation.size()), "pairs", Better::neither});
    for (std::size_t d = 0; d < deltas_.size(); ++d) {
      char name[32];
      std::snprintf(name, sizeof name, "%gm.", deltas_[d]);
      report(name, by_delta[d], metrics);
    }
    for (std::size_t m = 0; m < atlas.missions.size(); ++m)
      report(atlas.missions[m].mission->name + ".", by_mission[m], metrics);
    return metrics;
  }

 private:
  std::vector<double> deltas_ = {10, 20, 50};
  double tolerance_ = 0.2;
  double max_time_difference_ = 0.01;
};

}  // namespace

CAMBIUM_PLUGIN("rpe", "0.1.0") {
  registry.add<RelativePoseError>("rpe", "Relative pose error over fixed lengths of path");
}
