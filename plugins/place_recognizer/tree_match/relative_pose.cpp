// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "search.hpp"

namespace tree_match {

using cambium::SE3;
using cambium::Vec3;

// The map has drifted a little between its nodes; what both nodes saw themselves has not.
SE3 Reference::relative_pose(const Overlay& overlay, std::span<const Stem> stems,
                             const Place& query, std::size_t q, std::size_t r) const {
  constexpr auto all = std::numeric_limits<std::uint32_t>::max();
  const Vec3 at = place_.T_mission_node[r].t - place_.T_mission_node[0].t;
  Planar planar = overlay.T_reference_query;  // of the query, from node r
  planar.x -= at.x();
  planar.y -= at.y();
  const auto from = query.seen_from(q), to = place_.seen_from(r);
  const StemGrid grid(to);
  AlignmentLimits limits = limits_.alignment;
  limits.coarse_radius = limits_.table_radius;
  Overlayer overlayer(to, grid, limits);
  Overlay own = overlayer.start(from, planar, all);
  overlayer.finish(from, all, own);
  const Planar& refined = own.T_reference_query;
  const double moved = std::hypot(refined.x - planar.x, refined.y - planar.y);
  const bool good =
      own.matches.size() >= std::size_t(limits_.table_matches) && moved < 2 * limits_.table_radius;
  if (good) planar = refined;
  // Heights are those of the maps, which many nodes agree on; those of one node may all be wrong.
  std::optional<SE3> T_r_upright = lift(overlay, stems, place_.stems, limits_.sigma_tilt);
  if (T_r_upright) {
    T_r_upright->q = SE3::from_yaw(planar.yaw - overlay.T_reference_query.yaw).q * T_r_upright->q;
    T_r_upright->t = Vec3(planar.x, planar.y, T_r_upright->t.z() - at.z());
  }
  // Without heights, robots are taken to be as high above the ground, and the ground as even.
  if (!T_r_upright) T_r_upright = SE3::from_yaw(planar.yaw, Vec3(planar.x, planar.y, 0));
  return SE3{place_.T_mission_node[r].q.conjugate(), Vec3::Zero()} * *T_r_upright *
         SE3{query.T_mission_node[q].q, Vec3::Zero()};
}

}  // namespace tree_match
