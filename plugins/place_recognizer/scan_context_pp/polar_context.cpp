// SPDX-License-Identifier: BSD-3-Clause
#include "polar_context.hpp"

#include <numbers>

namespace scan_context_pp {

using namespace cambium;

void PolarContext::params(ParamVisitor& v) {
  v("rings", grid_.shape.rings, "Rings of the polar grid", between(1, 200));
  v("sectors", grid_.shape.sectors, "Sectors of the polar grid", between(4, columns::most_sectors));
  v("max_range", grid_.max_range, "Horizontal radius of the polar grid", above(0.0, "m"));
  v("lateral_views", lateral_views_, "Virtual viewpoints on each side, for the polar context",
    between(0, 50));
  v("lateral_step", lateral_step_, "Distance between the virtual viewpoints", above(0.0, "m"));
  v("polar_threshold", threshold_, "Pairs of a larger polar distance are not proposed",
    between(0.01, 1.0));
}

std::vector<Eigen::Vector2f> PolarContext::views() const {
  std::vector<Eigen::Vector2f> out = {Eigen::Vector2f::Zero()};
  for (int i = 1; i <= lateral_views_; ++i)
    for (const double side : {1.0, -1.0}) out.emplace_back(0.0f, float(side * i * lateral_step_));
  return out;
}

void PolarContext::describe(const Cloud::Matrix3X& levelled, double height_offset,
                            std::span<float> numbers) const {
  columns::PolarGrid grid = grid_;
  grid.height_offset = height_offset;
  const auto viewpoints = views();
  const std::size_t bins = grid.shape.bins();
  for (std::size_t i = 0; i < viewpoints.size(); ++i)
    columns::describe(levelled, grid, viewpoints[i], numbers.subspan(i * bins, bins));
}

void PolarContext::encode(Fingerprints& fingerprints, Place at, const Context& context) const {
  columns::encode_tiles(fingerprints, {fingerprints, grid_.shape, 1, at.column, at.byte}, context);
}

std::vector<Placements> PolarContext::match(const Missions& missions, Place query, Place reference,
                                            columns::Limits limits, const Context& context) const {
  limits.threshold = threshold_;
  const auto viewpoints = views();
  const auto matches =
      columns::search({missions.query, grid_.shape, viewpoints.size(), query.column, query.byte},
                      {missions.reference, grid_.shape, 1, reference.column, reference.byte},
                      missions.pairing, limits, context);
  std::vector<Placements> out(matches.size());
  for (std::size_t q = 0; q < matches.size(); ++q)
    for (const columns::Match& m : matches[q]) {
      const double yaw = 2.0 * std::numbers::pi * m.shift / grid_.shape.sectors;
      const Vec3 from(viewpoints[m.view].x(), viewpoints[m.view].y(), 0.0);
      out[q].push_back({m.reference, 1.0 - m.distance / threshold_,
                        SE3::from_yaw(yaw) * SE3{Quat::Identity(), -from}});
    }
  return out;
}

}  // namespace scan_context_pp
