// SPDX-License-Identifier: BSD-3-Clause
// Point-to-plane ICP (Chen, Medioni 1992).
#include "common/near_guess.hpp"

namespace cambium::registration {
namespace {

class IcpPointToPlane final : public NearGuess {
 public:
  void params(ParamVisitor& v) override {
    NearGuess::params(v);
    correspondence_params(v);
  }

 private:
  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    return optimise(target.surface, source.sample, guess, stage, {});
  }
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("icp_point_to_plane", "0.2.0") {
  registry.add<cambium::registration::IcpPointToPlane>(
      "icp_point_to_plane", "Point-to-plane ICP, coarse to fine, after a search for the start");
}
