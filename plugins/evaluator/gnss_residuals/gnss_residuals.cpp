// SPDX-License-Identifier: BSD-3-Clause
// How far the map lies from what the receivers measured. Needs no truth.
#include <algorithm>
#include <cmath>
#include <string>

#include "cambium/fused.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"
#include "cambium/plugin.hpp"
#include "cambium/statistics.hpp"

namespace {

using namespace cambium;

/// Where the mission was at a time, between the nodes around it; nothing outside of the path, or
/// where the nodes are more than `max_gap` [s] apart. `path` is in order of time.
std::optional<Vec3> position_at(const std::vector<StampedPose>& path, const Stamp& stamp,
                                double max_gap) {
  const auto after = std::lower_bound(
      path.begin(), path.end(), stamp,
      [](const StampedPose& pose, const Stamp& value) { return pose.stamp < value; });
  if (after == path.end()) return std::nullopt;
  if (after->stamp == stamp) return after->T_map_node.t;
  if (after == path.begin()) return std::nullopt;
  const auto before = std::prev(after);
  const double gap = seconds_between(before->stamp, after->stamp);
  if (gap > max_gap) return std::nullopt;
  const double s = seconds_between(before->stamp, stamp) / gap;
  return (1 - s) * before->T_map_node.t + s * after->T_map_node.t;
}

struct Residuals {
  std::vector<double> horizontal, vertical;  // [m]
  std::vector<double> normalised;  // horizontal, in standard deviations that the receiver states
  std::size_t unused = 0;          // fixes without a place on the path or the globe

  void add(const Residuals& other) {
    horizontal.insert(horizontal.end(), other.horizontal.begin(), other.horizontal.end());
    vertical.insert(vertical.end(), other.vertical.begin(), other.vertical.end());
    normalised.insert(normalised.end(), other.normalised.begin(), other.normalised.end());
    unused += other.unused;
  }
};

bool on_the_globe(const GnssFix& fix) {
  return std::isfinite(fix.latitude + fix.longitude + fix.altitude) && std::abs(fix.latitude) <= 90;
}

Residuals residuals_of(const MissionState& state, const GeoReference& g, double max_gap) {
  std::vector<StampedPose> path = trajectory(state);
  std::stable_sort(path.begin(), path.end(),
                   [](const StampedPose& a, const StampedPose& b) { return a.stamp < b.stamp; });
  const SE3 T_enu_map = g.T_map_enu.inverse();
  Residuals out;
  for (const GnssFix& fix : state.mission->fixes) {
    const auto p_map = position_at(path, fix.stamp, max_gap);
    if (!p_map || !on_the_globe(fix)) {
      ++out.unused;
      continue;
    }
    const Vec3 r = T_enu_map * *p_map - to_enu({g.latitude, g.longitude, g.altitude},
                                               {fix.latitude, fix.longitude, fix.altitude});
    out.horizontal.push_back(r.head<2>().norm());
    out.vertical.push_back(r.z());
    const Eigen::Matrix2d C = fix.covariance.topLeftCorner<2, 2>();
    if (C.determinant() > 0)
      out.normalised.push_back(std::sqrt(r.head<2>().dot(C.inverse() * r.head<2>()) / 2));
  }
  return out;
}

void report(const std::string& name, const Residuals& r, std::vector<Metric>& metrics) {
  if (r.horizontal.empty()) return;
  const auto add = [&](const char* what, double value, const char* unit, Better better) {
    metrics.push_back({"gnss_residuals." + name + what, value, unit, better});
  };
  add("horizontal", rms(r.horizontal), "m", Better::lower);
  add("vertical", rms(r.vertical), "m", Better::lower);
  add("horizontal_median", median(r.horizontal), "m", Better::lower);
  if (!r.normalised.empty()) add("normalised", rms(r.normalised), "", Better::neither);
}

class GnssResiduals final : public Evaluator {
 public:
  void params(ParamVisitor& v) override {
    v("max_gap", max_gap_, "Fixes between nodes farther apart in time have no place on the path",
      above(0, "s"));
  }

  bool needs_truth() const override { return false; }

  std::vector<Metric> evaluate(const Atlas& atlas, const std::filesystem::path&,
                               const Context& context) const override {
    Residuals all;
    std::vector<Residuals> by_mission(atlas.missions.size());
    for (const Island& island : atlas.islands) {
      const auto g = georeference(atlas, island);
      for (const std::uint32_t m : island.missions) {
        context.check_cancelled();
        const MissionState& state = atlas.missions[m];
        if (state.mission->fixes.empty()) continue;
        if (!g)
          context.warn(state.mission->name + " has GNSS fixes, but its map is not georeferenced: " +
                       "put a 'georeference' step before 'evaluate: gnss_residuals'");
        else
          by_mission[m] = residuals_of(state, *g, max_gap_);
        all.add(by_mission[m]);
      }
    }
    std::vector<Metric> metrics;
    report("", all, metrics);
    metrics.push_back(
        {"gnss_residuals.fixes", double(all.horizontal.size()), "fixes", Better::neither});
    metrics.push_back(
        {"gnss_residuals.unused_fixes", double(all.unused), "fixes", Better::neither});
    for (std::size_t m = 0; m < by_mission.size(); ++m)
      report(atlas.missions[m].mission->name + ".", by_mission[m], metrics);
    return metrics;
  }

 private:
  double max_gap_ = 30;
};

}  // namespace

CAMBIUM_PLUGIN("gnss_residuals", "0.1.0") {
  registry.add<GnssResiduals>("gnss_residuals",
                              "Distances between the map and the GNSS fixes; no truth needed");
}
