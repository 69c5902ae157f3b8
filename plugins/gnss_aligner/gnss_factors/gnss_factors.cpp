// SPDX-License-Identifier: BSD-3-Clause
// GNSS as loop closure along the whole path: the alignment of gnss_trajectory, and positions of the
// nodes for the optimisation that follows.
#include "cambium/plugin.hpp"
#include "common/carry.hpp"
#include "positions.hpp"

namespace gnss_factors {
namespace {

using namespace cambium;

class GnssFactors final : public GnssAligner {
 public:
  void params(ParamVisitor& v) override {
    fit_.params(v);
    v("sigma_scale", positions_.sigma_scale,
      "The true sigma of the fixes over the stated one; more makes the factors weaker", above(0));
    v("vertical_scale", positions_.vertical_scale, "The same for height, in addition", above(0));
    v("correlation_time", positions_.correlation_time,
      "Errors of fixes are alike for so long; 0 = independent", at_least(0, "s"));
    v("window", positions_.window,
      "Fixes that jump are told by the median over this time; several times a jump's duration",
      above(0, "s"));
  }
  std::string check_params() const override { return fit_.mounting.check(); }

  GnssAlignment align(const Atlas& atlas, const Island& island,
                      const Context& context) const override {
    context.check_cancelled();
    gnss::TrajectoryFit fit = gnss::fit_trajectory(atlas, island, fit_);
    GnssAlignment& found = fit.alignment;
    if (!found.georeference) return gnss::or_carried(found, atlas, island);
    PositionSettings settings = positions_;
    settings.outlier_width = fit_.outlier_width;
    for (const gnss::Track& track : fit.tracks.tracks)
      for (const NodePosition& p :
           node_positions(atlas, track, found.georeference->T_map_enu, settings))
        found.positions.push_back(p);
    return found;
  }

 private:
  gnss::FitSettings fit_;
  PositionSettings positions_;
};

}  // namespace
}  // namespace gnss_factors

CAMBIUM_PLUGIN("gnss_factors", "0.1.0") {
  registry.add<gnss_factors::GnssFactors>(
      "gnss_factors", "gnss_trajectory, and a position factor for every node near a fix");
}
