// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by Scan Context (Kim & Kim, IROS 2018), exact over all column shifts.
#include <algorithm>

#include "cambium/plugin.hpp"
#include "descriptor.hpp"
#include "search.hpp"

namespace scan_context {

using namespace cambium;

// A row of the fingerprints: the columns of the descriptor, then q_level_base as x y z w.
constexpr std::size_t rotation_size = 4;

class ScanContext final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("rings", grid_.rings, "Rings of the polar grid", between(1, 200));
    v("sectors", grid_.sectors, "Sectors of the polar grid", between(4, 720));
    v("max_range", grid_.max_range, "Horizontal radius of the grid", above(0.0, "m"));
    v("height_offset", grid_.height_offset,
      "Points up to this far below the base count, lower ones do not", in_unit("m"));
    v("level", level_, "Set each cloud upright by the roll and pitch of its node first");
    v("view_radius", view_radius_,
      "Queries are also described from viewpoints up to this far around the base",
      between(0.0, 100.0, "m"));
    v("view_step", view_step_, "Distance between viewpoints", above(0.0, "m"));
    v("candidates", limits_.candidates, "At most so many proposals for a query", between(1, 10000));
    v("threshold", limits_.threshold, "Pairs of a larger distance are not proposed",
      between(0.0, 1.0));
    v("min_overlap", limits_.min_overlap, "Share of the sectors that both clouds must have filled",
      between(0.0, 1.0));
  }

  // Viewpoints around the base turn with it.
  bool yaw_invariant() const override { return view_radius_ < view_step_; }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    const auto views = viewpoints(view_radius_, view_step_);
    const std::size_t bins = grid_.bins();
    Fingerprints out{mission.size(), views.size() * bins + rotation_size, {}, {}};
    out.table.resize(out.rows * out.cols, 0.0f);
    context.parallel_for(out.rows, [&](std::size_t i) {
      context.check_cancelled();
      const std::span<float> row{out.table.data() + i * out.cols, out.cols};
      Quat q_level_base = Quat::Identity();
      if (level_) q_level_base = level_rotation(mission.mission().nodes[i].T_mission_node);
      std::copy_n(q_level_base.coeffs().data(), rotation_size, row.last(rotation_size).begin());
      const Payload payload = mission.payload(i);
      if (!payload.cloud) return;  // an empty descriptor matches nothing
      const Cloud::Matrix3X points = levelled(*payload.cloud, q_level_base);
      for (std::size_t v = 0; v < views.size(); ++v)
        scan_context::describe(points, grid_, views[v], row.subspan(v * bins, bins));
    });
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    check_size(query);
    check_size(reference);
    const auto views = viewpoints(view_radius_, view_step_);
    std::vector<Spectra> queries;
    for (std::size_t v = 0; v < views.size(); ++v)
      queries.emplace_back(query, v * grid_.bins(), grid_.rings, grid_.sectors);
    const Spectra references(reference, 0, grid_.rings, grid_.sectors);
    const auto matches = search(queries, references, pairing, limits_, context);
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < matches.size(); ++q)
      for (const Match& m : matches[q]) {
        // The reference's base is taken to stand at the viewpoint.
        const Eigen::Vector2d from = views[m.view].cast<double>();
        const SE3 T_reference_query =
            level_base(reference, m.reference).inverse() * SE3::from_yaw(m.yaw) *
            SE3{Quat::Identity(), Vec3(-from.x(), -from.y(), 0.0)} * level_base(query, q);
        out.push_back({q, m.reference, 1.0 - m.distance, T_reference_query});
      }
    return out;
  }

 private:
  static SE3 level_base(const Fingerprints& fingerprints, std::size_t node) {
    const std::span<const float> q = fingerprints.row(node).last(rotation_size);
    return {Quat(q[3], q[0], q[1], q[2]).normalized(), Vec3::Zero()};
  }

  // A pipeline may give platforms other parameters; their descriptors cannot be compared.
  void check_size(const Fingerprints& fingerprints) const {
    const std::size_t expected =
        viewpoints(view_radius_, view_step_).size() * grid_.bins() + rotation_size;
    if (fingerprints.cols != expected)
      throw Error(ErrorCode::config, "scan_context",
                  "a mission was described with " + std::to_string(fingerprints.cols) +
                      " numbers a node, expected " + std::to_string(expected) +
                      "; give rings, sectors and views the same values for all platforms");
  }

  Grid grid_;
  Limits limits_;
  bool level_ = true;
  double view_radius_ = 0.0;
  double view_step_ = 2.0;
};

}  // namespace scan_context

CAMBIUM_PLUGIN("scan_context", "0.1.0") {
  registry.add<scan_context::ScanContext>(
      "scan_context", "Polar grid of heights, compared over all headings (Scan Context, 2018)");
}
