// SPDX-License-Identifier: BSD-3-Clause
// Generalized-ICP (Segal, Haehnel, Thrun, RSS 2009).
#include "common/near_guess.hpp"

namespace cambium::registration {
namespace {

class Gicp final : public NearGuess {
 public:
  Gicp() { source_points_ = 20000; }
  void params(ParamVisitor& v) override {
    NearGuess::params(v);
    correspondence_params(v);
    v("plane_thickness", plane_thickness_,
      "Variance across a surface, where that along it is 1; larger is nearer to point-to-point",
      between(1e-6, 1.0));
  }

 private:
  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    return optimise(target.surface, source.sample, guess, stage, {plane_thickness_});
  }

  double plane_thickness_ = 0.001;
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("gicp", "0.2.0") {
  registry.add<cambium::registration::Gicp>(
      "gicp", "Generalized-ICP, coarse to fine, after a search for the start");
}
