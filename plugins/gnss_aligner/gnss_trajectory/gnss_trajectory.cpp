// SPDX-License-Identifier: BSD-3-Clause
// Yaw and translation from every fix along the path, robustly, and how well they are known.
#include "cambium/plugin.hpp"
#include "common/carry.hpp"
#include "common/trajectory_fit.hpp"

namespace {

using namespace cambium;

class GnssTrajectory final : public GnssAligner {
 public:
  void params(ParamVisitor& v) override { settings_.params(v); }
  std::string check_params() const override { return settings_.mounting.check(); }

  GnssAlignment align(const Atlas& atlas, const Island& island,
                      const Context& context) const override {
    context.check_cancelled();
    const GnssAlignment found = gnss::fit_trajectory(atlas, island, settings_).alignment;
    return found.georeference ? found : gnss::or_carried(found, atlas, island);
  }

 private:
  gnss::FitSettings settings_;
};

}  // namespace

CAMBIUM_PLUGIN("gnss_trajectory", "0.1.0") {
  registry.add<GnssTrajectory>(
      "gnss_trajectory", "Yaw and translation from all fixes along the path, robust to wrong ones");
}
