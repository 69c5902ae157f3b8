// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "conformance/law.hpp"

namespace cambium::conformance {
namespace {

std::string align(const Subject& s, const Atlas& atlas, const Context& context) {
  const GnssAlignment a = s.as<GnssAligner>().align(atlas, atlas.islands[0], context);
  if (!a.georeference) {
    require(!a.reason.empty(), "gives no georeference, and no reason");
    return a.reason + encode(a.scores);
  }
  const GeoReference& g = *a.georeference;
  require(std::isfinite(g.latitude) && std::abs(g.latitude) <= 90 && std::isfinite(g.longitude) &&
              std::isfinite(g.altitude) && g.T_map_enu.finite(),
          "the georeference is not finite");
  require(g.sigma_yaw >= 0 && g.sigma_position >= 0, "a sigma is negative");
  return encode(g.latitude) + encode(g.longitude) + encode(g.altitude) + encode(g.T_map_enu) +
         encode(g.sigma_yaw) + encode(a.scores);
}

Atlas with_fixes(const Atlas& atlas, const std::function<void(std::vector<GnssFix>&)>& change) {
  Atlas out = atlas;
  for (MissionState& state : out.missions) {
    Mission mission = *state.mission;
    change(mission.fixes);
    state.mission = std::make_shared<const Mission>(std::move(mission));
  }
  return out;
}

void refuses_without_fixes(const Subject& s) {
  const Host host(1);
  const Atlas none = with_fixes(s.world.atlas, [](auto& fixes) { fixes.clear(); });
  require(!s.as<GnssAligner>().align(none, none.islands[0], *host.context()).georeference,
          "georeferences an island that has no fix at all");
}

}  // namespace

Exercise exercise_aligner(const Subject& s) {
  const auto on = [&s](std::function<void(std::vector<GnssFix>&)> change) -> Call {
    return
        [&s, change](const Context& c) { return align(s, with_fixes(s.world.atlas, change), c); };
  };
  Exercise e;
  e.usual = on([](auto&) {});
  e.odd = {
      {"no fixes", on([](auto& fixes) { fixes.clear(); })},
      {"one fix", on([](auto& fixes) { fixes.resize(std::min<std::size_t>(1, fixes.size())); })},
      {"fixes that are not finite", on([](auto& fixes) {
         for (std::size_t i = 0; i < fixes.size(); i += 2)
           fixes[i].latitude = std::numeric_limits<double>::quiet_NaN();
       })},
      {"covariances of zero", on([](auto& fixes) {
         for (GnssFix& fix : fixes) fix.covariance.setZero();
       })}};
  e.own = {{"refuses an island without fixes", refuses_without_fixes}};
  return e;
}

}  // namespace cambium::conformance
