// SPDX-License-Identifier: BSD-3-Clause
// Keeps the points of a cloud whose distance from the base, and height, are within limits.
#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

class RangeCrop final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("min_range", min_range_, "Nearer points are dropped: the robot itself", at_least(0.0, "m"));
    v("max_range", max_range_, "Farther points are dropped", above(0.0, "m"));
    v("z_limits", z_limits_, "[lowest, highest] z in the base frame; empty keeps every height",
      in_unit("m"));
  }

  std::string check_params() const override {
    if (min_range_ >= max_range_) return "min_range must be below max_range";
    if (z_limits_.empty()) return {};
    if (z_limits_.size() != 2) return "z_limits must be [lowest, highest] or []";
    if (z_limits_[0] >= z_limits_[1]) return "z_limits: the first must be below the second";
    return {};
  }

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    const auto points = payload.cloud->points();
    std::vector<std::size_t> kept;
    std::size_t not_finite = 0;
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      if (!points.col(i).allFinite())
        ++not_finite;
      else if (inside(points.col(i).cast<double>()))
        kept.push_back(std::size_t(i));
    }
    if (not_finite > 0)
      context.warn(mission.mission().name + " node " +
                   std::to_string(mission.mission().nodes[node].id) + ": range_crop dropped " +
                   std::to_string(not_finite) + " of " + std::to_string(points.cols()) +
                   " points that are not finite");
    payload.cloud = std::make_shared<const Cloud>(select(*payload.cloud, kept));
    return payload;
  }

 private:
  bool inside(const Vec3& p) const {
    const double range = p.norm();
    if (range < min_range_ || range > max_range_) return false;
    return z_limits_.empty() || (p.z() >= z_limits_[0] && p.z() <= z_limits_[1]);
  }

  double min_range_ = 0.5;
  double max_range_ = 80.0;
  std::vector<double> z_limits_;
};

}  // namespace

CAMBIUM_PLUGIN("range_crop", "0.1.0") {
  registry.add<RangeCrop>("range_crop", "Keeps the points within limits of distance and height");
}
