// SPDX-License-Identifier: BSD-3-Clause
// Ties an island to the globe by yaw and position, from each fix and the node nearest in time.
// Replace align() by your method; what to keep to: docs/write-a-plugin.md.
#include <cmath>

#include "cambium/fit.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/path.hpp"
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public GnssAligner {
 public:
  void params(ParamVisitor& v) override {
    v("max_gap", max_gap_, "A fix counts when a node's stamp is this near", above(0.0, "s"));
    v("min_spread", min_spread_, "Fixes must reach this far, or yaw is not observable",
      above(0.0, "m"));
  }

  GnssAlignment align(const Atlas& atlas, const Island& island, const Context&) const override {
    std::vector<Vec3> map, enu;
    std::optional<Geodetic> reference;
    for (const std::uint32_t m : island.missions)
      for (const GnssFix& fix : atlas.missions[m].mission->fixes) {
        const auto node = nearest(*atlas.missions[m].mission, fix.stamp);
        const Geodetic point{fix.latitude, fix.longitude, fix.altitude};
        if (!node || !std::isfinite(point.latitude + point.longitude + point.altitude)) continue;
        if (!reference) reference = point;
        enu.push_back(to_enu(*reference, point));
        map.push_back((*atlas.missions[m].T_map_node)[*node].t);
      }
    double spread = 0;
    for (const Vec3& p : enu) spread = std::max(spread, (p - enu.front()).head<2>().norm());
    if (spread < min_spread_)
      return {std::nullopt, "the fixes reach " + std::to_string(spread) + " m only", {}};
    GeoReference out{reference->latitude, reference->longitude, reference->altitude, {}, 0, 0};
    out.T_map_enu = fit_yaw(map, enu);
    return {out, {}, {{"fixes", double(enu.size())}}};
  }

 private:
  std::optional<std::size_t> nearest(const Mission& mission, const Stamp& stamp) const {
    std::optional<std::size_t> best;
    double least = max_gap_;
    for (std::size_t i = 0; i < mission.nodes.size(); ++i) {
      if (!mission.nodes[i].stamp) continue;
      const double gap = std::abs(seconds_between(*mission.nodes[i].stamp, stamp));
      if (gap <= least) least = gap, best = i;
    }
    return best;
  }

  double max_gap_ = 1.0, min_spread_ = 10.0;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "Yaw and position from fixes and the nodes nearest in time");
}
