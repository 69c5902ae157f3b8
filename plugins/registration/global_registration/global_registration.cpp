// SPDX-License-Identifier: BSD-3-Clause
// Registration without a guess: plans of both scans are correlated over every heading and
// translation, the best placements are refined by Generalized-ICP, and what the scans see through
// decides between them.
#include "common/coarse_to_fine.hpp"
#include "correlate.hpp"

namespace cambium::registration {
namespace {

class GlobalRegistration final : public CoarseToFine {
 public:
  GlobalRegistration() {
    source_points_ = 20000;
    coarse_correspondence_distance_ = 3.0;
    min_overlap_ = 0.4;
    max_seen_through_ = 0.08;
  }
  void params(ParamVisitor& v) override {
    CoarseToFine::params(v);
    correspondence_params(v);
    v("cell_size", grid_.cell, "Cell of the plans; 128 x 128 of them", above(0.0, "m"));
    v("max_range", grid_.max_range, "Points farther out are not on the plan", above(0.0, "m"));
    v("max_distance", max_distance_, "Scans taken farther apart are not found", above(0.0, "m"));
    v("hypotheses", hypotheses_, "How many distinct placements are refined", between(1, 100));
    v("plane_thickness", plane_thickness_,
      "Variance across a surface, where that along it is 1; larger is nearer to point-to-point",
      between(1e-6, 1.0));
  }
  std::string check_params() const override {
    // The plans are periodic: a placement must not meet the other side of the grid.
    if (max_range_fits()) return CoarseToFine::check_params();
    return "max_distance and max_range must be at most 64 cell_size";
  }

 private:
  bool max_range_fits() const {
    return std::max(max_distance_, grid_.max_range) <= grid_.cell * grid_.width / 2;
  }
  void extend(PreparedCloud& cloud) const override {
    auto plan = std::make_shared<const Plan>(make_plan(cloud.fine.surface.patches, grid_, fft_));
    cloud.extra_bytes = plan->bytes();
    cloud.extra = std::move(plan);
  }
  std::vector<SE3> starts(const PreparedCloud& target, const PreparedCloud& source,
                          const SE3& /*guess*/) const override {
    std::vector<SE3> starts;
    for (const Hypothesis& h : correlate(*static_cast<const Plan*>(target.extra.get()),
                                         *static_cast<const Plan*>(source.extra.get()), grid_, fft_,
                                         max_distance_, std::size_t(hypotheses_)))
      starts.push_back(h.T_target_source);
    return starts;
  }
  std::optional<SE3> refine(const Level& target, const Level& source, const SE3& guess,
                            const Stage& stage) const override {
    return optimise(target.surface, source.sample, guess, stage, {plane_thickness_});
  }

  PlanGrid grid_;
  Fft fft_{grid_.width};
  double max_distance_ = 45;
  int hypotheses_ = 8;
  double plane_thickness_ = 0.001;
};

}  // namespace
}  // namespace cambium::registration

CAMBIUM_PLUGIN("global_registration", "0.1.0") {
  registry.add<cambium::registration::GlobalRegistration>(
      "global_registration", "Needs no guess: plans correlated over all placements, then GICP");
}
