// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by Scan Context (Kim & Kim, IROS 2018), exact over all column shifts.
#include <numbers>

#include "cambium/plugin.hpp"
#include "common/levelled.hpp"
#include "common/polar.hpp"
#include "common/search.hpp"
#include "viewpoints.hpp"

namespace scan_context {

using namespace cambium;

// A row of the fingerprints: the descriptor of each viewpoint, then q_level_base. The rest of them
// are the tiles that a search reads.

class ScanContext final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("rings", grid_.shape.rings, "Rings of the polar grid", between(1, 200));
    v("sectors", grid_.shape.sectors, "Sectors of the polar grid",
      between(4, columns::most_sectors));
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
    const std::size_t bins = grid_.shape.bins();
    Fingerprints out{mission.size(), views.size() * bins + columns::rotation_size, {}, {}};
    out.table.resize(out.rows * out.cols, 0.0f);
    out.extra.resize(columns::tile_bytes(out.rows, grid_.shape));
    context.parallel_for(out.rows, [&](std::size_t i) {
      context.check_cancelled();
      const std::span<float> row{out.table.data() + i * out.cols, out.cols};
      const Cloud::Matrix3X points =
          columns::upright_points(mission, i, level_, row.last(columns::rotation_size));
      if (points.cols() == 0) return;  // an empty descriptor matches nothing
      for (std::size_t v = 0; v < views.size(); ++v)
        columns::describe(points, grid_, views[v], row.subspan(v * bins, bins));
    });
    columns::encode_tiles(out, {out, grid_.shape}, context);
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    check_size(query);
    check_size(reference);
    const auto views = viewpoints(view_radius_, view_step_);
    const auto matches = columns::search({query, grid_.shape, views.size()},
                                         {reference, grid_.shape}, pairing, limits_, context);
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < matches.size(); ++q)
      for (const columns::Match& m : matches[q]) {
        // The reference's base is taken to stand at the viewpoint.
        const Eigen::Vector2d from = views[m.view].cast<double>();
        const double yaw = 2.0 * std::numbers::pi * m.shift / grid_.shape.sectors;
        const SE3 T_reference_query =
            level_base(reference, m.reference).inverse() * SE3::from_yaw(yaw) *
            SE3{Quat::Identity(), Vec3(-from.x(), -from.y(), 0.0)} * level_base(query, q);
        out.push_back({q, m.reference, 1.0 - m.distance, T_reference_query});
      }
    return out;
  }

 private:
  static SE3 level_base(const Fingerprints& fingerprints, std::size_t node) {
    return columns::T_level_base(fingerprints.row(node).last(columns::rotation_size));
  }

  // A pipeline may give platforms other parameters; their descriptors cannot be compared.
  void check_size(const Fingerprints& fingerprints) const {
    const std::size_t expected =
        viewpoints(view_radius_, view_step_).size() * grid_.shape.bins() + columns::rotation_size;
    if (fingerprints.cols != expected ||
        fingerprints.extra.size() != columns::tile_bytes(fingerprints.rows, grid_.shape))
      throw Error(ErrorCode::config, "scan_context",
                  "a mission was described with " + std::to_string(fingerprints.cols) +
                      " numbers a node, expected " + std::to_string(expected) +
                      "; give rings, sectors and views the same values for all platforms");
  }

  columns::PolarGrid grid_;
  columns::Limits limits_;
  bool level_ = true;
  double view_radius_ = 0.0;
  double view_step_ = 2.0;
};

}  // namespace scan_context

CAMBIUM_PLUGIN("scan_context", "0.1.0") {
  registry.add<scan_context::ScanContext>(
      "scan_context", "Polar grid of heights, compared over all headings (Scan Context, 2018)");
}
