// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by Scan Context++ (Kim, Choi, Kim, T-RO 2022), exact over all column shifts.
#include <algorithm>

#include "cambium/plugin.hpp"
#include "cartesian_context.hpp"
#include "common/levelled.hpp"
#include "polar_context.hpp"

namespace scan_context_pp {

using namespace cambium;

// A row of the fingerprints: the numbers of the polar context, those of the cartesian one, then
// q_level_base. The rest of them are the tiles of the contexts, in the same order.
class ScanContextPlusPlus final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("context", context_,
      "polar: any heading, near the path; cartesian: along the path or against it, lanes apart",
      one_of({"both", "polar", "cartesian"}));
    polar_.params(v);
    cartesian_.params(v);
    v("height_offset", height_offset_,
      "Points up to this far below the base count, lower ones do not", in_unit("m"));
    v("level", level_, "Set each cloud upright by the roll and pitch of its node first");
    v("candidates", limits_.candidates, "At most so many proposals for a query", between(1, 10000));
    v("min_overlap", limits_.min_overlap,
      "Share of the sectors, or of the lanes, that both clouds must have filled",
      between(0.0, 1.0));
  }
  std::string check_params() const override { return cartesian_.check_params(); }

  Fingerprints describe(const MissionView& mission, const Context& context) const override {
    Fingerprints out{mission.size(), row_size(), {}, {}};
    out.table.resize(out.rows * out.cols, 0.0f);
    out.extra.resize(polar_bytes(out.rows) + cartesian_bytes(out.rows));
    context.parallel_for(out.rows, [&](std::size_t i) {
      context.check_cancelled();
      const std::span<float> row{out.table.data() + i * out.cols, out.cols};
      const Cloud::Matrix3X points =
          columns::upright_points(mission, i, level_, row.last(columns::rotation_size));
      if (points.cols() == 0) return;  // an empty descriptor matches nothing
      if (uses_polar()) polar_.describe(points, height_offset_, row.first(polar_floats()));
      if (uses_cartesian())
        cartesian_.describe(points, height_offset_,
                            row.subspan(polar_floats(), cartesian_.floats()));
    });
    if (uses_polar()) polar_.encode(out, {}, context);
    if (uses_cartesian()) cartesian_.encode(out, cartesian_place(out), context);
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override {
    check_size(query);
    check_size(reference);
    const Missions missions{query, reference, pairing};
    std::vector<Placements> cartesian(query.rows), polar(query.rows);
    if (uses_cartesian())
      cartesian = cartesian_.match(missions, cartesian_place(query), cartesian_place(reference),
                                   limits_of_each(), context);
    if (uses_polar()) polar = polar_.match(missions, {}, {}, limits_of_each(), context);
    std::vector<Candidate> out;
    for (std::size_t q = 0; q < query.rows; ++q)
      for (const Placement& p : merged(cartesian[q], polar[q]))
        out.push_back({q, p.reference, p.score,
                       level_base(reference, p.reference).inverse() * p.T_reference_query *
                           level_base(query, q)});
    return out;
  }

 private:
  bool uses_polar() const { return context_ != "cartesian"; }
  bool uses_cartesian() const { return context_ != "polar"; }
  std::size_t polar_floats() const { return uses_polar() ? polar_.floats() : 0; }
  std::size_t cartesian_floats() const { return uses_cartesian() ? cartesian_.floats() : 0; }
  std::size_t polar_bytes(std::size_t nodes) const {
    return uses_polar() ? polar_.bytes(nodes) : 0;
  }
  std::size_t cartesian_bytes(std::size_t nodes) const {
    return uses_cartesian() ? cartesian_.bytes(nodes) : 0;
  }
  std::size_t row_size() const {
    return polar_floats() + cartesian_floats() + columns::rotation_size;
  }
  Place cartesian_place(const Fingerprints& fingerprints) const {
    return {polar_floats(), polar_bytes(fingerprints.rows)};
  }

  // The distances of the two contexts mean different things, so each has its half of the proposals.
  columns::Limits limits_of_each() const {
    columns::Limits limits = limits_;
    if (context_ == "both") limits.candidates = (limits_.candidates + 1) / 2;
    return limits;
  }

  /// The best of both contexts, then the second best, ...; a reference that both found counts as
  /// the first one placed it.
  static Placements merged(const Placements& a, const Placements& b) {
    Placements out;
    for (std::size_t rank = 0; rank < std::max(a.size(), b.size()); ++rank)
      for (const Placements* list : {&a, &b}) {
        if (rank >= list->size()) continue;
        const Placement& next = (*list)[rank];
        const auto same = [&](const Placement& p) { return p.reference == next.reference; };
        if (std::none_of(out.begin(), out.end(), same)) out.push_back(next);
      }
    return out;
  }

  static SE3 level_base(const Fingerprints& fingerprints, std::size_t node) {
    return columns::T_level_base(fingerprints.row(node).last(columns::rotation_size));
  }

  // A pipeline may give platforms other parameters; their descriptors cannot be compared.
  void check_size(const Fingerprints& fingerprints) const {
    if (fingerprints.cols == row_size() &&
        fingerprints.extra.size() ==
            polar_bytes(fingerprints.rows) + cartesian_bytes(fingerprints.rows))
      return;
    throw Error(ErrorCode::config, "scan_context_pp",
                "a mission was described with " + std::to_string(fingerprints.cols) +
                    " numbers a node, expected " + std::to_string(row_size()) +
                    "; give grids and views the same values for all platforms");
  }

  std::string context_ = "both";
  PolarContext polar_;
  CartesianContext cartesian_;
  double height_offset_ = 2.0;
  bool level_ = true;
  columns::Limits limits_{10, 1.0, 0.5};
};

}  // namespace scan_context_pp

CAMBIUM_PLUGIN("scan_context_pp", "0.1.0") {
  registry.add<scan_context_pp::ScanContextPlusPlus>(
      "scan_context_pp",
      "Polar and cartesian grids of heights: also reversed and parallel passes (Scan Context++)");
}
