// SPDX-License-Identifier: BSD-3-Clause
#include "cartesian_context.hpp"

namespace scan_context_pp {

using namespace cambium;

void CartesianContext::params(ParamVisitor& v) {
  v("length", grid_.length, "The cartesian grid reaches so far ahead and behind", above(0.0, "m"));
  v("width", grid_.width, "The cartesian grid reaches so far to each side", above(0.0, "m"));
  v("bin", grid_.bin, "Edge of a bin of the cartesian grid", above(0.0, "m"));
  v("forward_views", grid_.steps,
    "Virtual viewpoints ahead and behind, one bin apart, for the cartesian context",
    between(0, 50));
  v("heading_views", grid_.headings, "Headings to each side, for the cartesian context",
    between(0, 50));
  v("heading_step", grid_.heading_step, "Angle between these headings", above(0.0, "rad"));
  v("cartesian_threshold", threshold_, "Pairs of a larger cartesian distance are not proposed",
    between(0.01, 1.0));
}

std::string CartesianContext::check_params() const {
  if (2 * grid_.width / grid_.bin > 360 || 2 * grid_.length / grid_.bin > 200)
    return "the cartesian grid has too many bins: expected at most 200 in 2 * length and 360 in "
           "2 * width; choose a larger bin";
  return {};
}

void CartesianContext::describe(const Cloud::Matrix3X& levelled, double height_offset,
                                std::span<float> numbers) const {
  const std::size_t bins = grid_.shape().bins(), count = grid_.height_count();
  const auto headings = grid_.all_headings();
  for (std::size_t i = 0; i < headings.size(); ++i)
    measure_heights(levelled, grid_, headings[i], height_offset,
                    numbers.subspan(bins + i * count, count));
  scan_context_pp::describe(numbers.subspan(bins, count), grid_, {}, numbers.first(bins));
}

void CartesianContext::encode(Fingerprints& fingerprints, Place at, const Context& context) const {
  columns::encode_tiles(fingerprints, {fingerprints, grid_.shape(), 1, at.column, at.byte},
                        context);
}

Fingerprints CartesianContext::all_views(const Fingerprints& query, Place at) const {
  const auto views = cartesian_views(grid_);
  const std::size_t bins = grid_.shape().bins();
  Fingerprints out{query.rows, views.size() * bins, {}, {}};
  out.table.resize(out.rows * out.cols);
  const std::size_t count = grid_.height_count();
  for (std::size_t i = 0; i < out.rows; ++i)
    for (std::size_t v = 0; v < views.size(); ++v)
      scan_context_pp::describe(
          query.row(i).subspan(at.column + bins + views[v].heading * count, count), grid_, views[v],
          {out.table.data() + i * out.cols + v * bins, bins});
  return out;
}

std::vector<Placements> CartesianContext::match(const Missions& missions, Place query,
                                                Place reference, columns::Limits limits,
                                                const Context& context) const {
  limits.threshold = threshold_;
  limits.min_overlap /= 2;  // half of the columns are no lanes
  const auto views = cartesian_views(grid_);
  const Fingerprints queries = all_views(missions.query, query);
  const auto matches =
      columns::search({queries, grid_.shape(), views.size()},
                      {missions.reference, grid_.shape(), 1, reference.column, reference.byte},
                      missions.pairing, limits, context);
  std::vector<Placements> out(matches.size());
  for (std::size_t q = 0; q < matches.size(); ++q)
    for (const columns::Match& m : matches[q]) {
      const SE3 T_reference_view{Quat::Identity(), {0, m.shift * grid_.bin, 0}};
      out[q].push_back({m.reference, 1.0 - m.distance / threshold_,
                        T_reference_view * T_base_view(grid_, views[m.view]).inverse()});
    }
  return out;
}

}  // namespace scan_context_pp
