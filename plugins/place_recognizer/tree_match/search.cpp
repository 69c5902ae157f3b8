// SPDX-License-Identifier: BSD-3-Clause
#include "search.hpp"

#include <numbers>

namespace tree_match {

using cambium::SE3;
using cambium::Vec3;

Reference::Reference(Place place, const Limits& limits)
    : limits_(limits),
      place_(std::move(place)),
      grid_(place_.stems),
      density_(densities(place_.stems, grid_)),
      coverage_(place_.stems, limits.alignment.cover),
      index_(std::move(place_.triangles), limits.index) {}

// The nearest node that saw at least half as many of the matched stems as any node did: between it
// and the stems lies little drift.
std::size_t Reference::nearest_node(const Overlay& overlay, std::uint32_t end) const {
  std::vector<int> change(place_.path.size() + 1, 0);
  for (const Match& m : overlay.matches) {
    ++change[place_.stems[m.reference].first];
    --change[place_.stems[m.reference].last + 1];
  }
  std::vector<int> seen;
  int sum = 0;
  for (std::size_t i = 0; i < std::size_t(end); ++i) seen.push_back(sum += change[i]);
  const int most = *std::max_element(seen.begin(), seen.end());
  const Vec3 origin = place_.T_mission_node[0].t;
  const Vec3 at(overlay.T_reference_query.x, overlay.T_reference_query.y, 0);
  std::size_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::size_t(end); ++i) {
    const double distance = (place_.T_mission_node[i].t - origin - at).head<2>().norm();
    if (2 * seen[i] < most || distance >= nearest) continue;
    nearest = distance;
    best = i;
  }
  return best;
}

// Wrong answers find many matches, too; what gives them away is that others find as many.
double Reference::rival(const std::vector<Overlay>& overlays, std::size_t node,
                        std::uint32_t end) const {
  const Planar& best = overlays.front().T_reference_query;
  double highest = 0;
  for (const Overlay& o : overlays) {
    const Planar& other = o.T_reference_query;
    const double between = std::abs(place_.path[nearest_node(o, end)] - place_.path[node]);
    const double distance = std::hypot(other.x - best.x, other.y - best.y);
    const double turned = std::remainder(other.yaw - best.yaw, 2 * std::numbers::pi);
    // Another pass along the same place is no rival: drift has moved its stems in the map.
    const double same = limits_.acceptance.distinct + limits_.acceptance.drift * between;
    if (distance > same || std::abs(turned) > same_yaw) highest = std::max(highest, o.score);
  }
  return highest;
}

std::vector<Overlay> Reference::hypotheses(std::span<const Stem> stems, std::uint32_t end) const {
  const StemGrid grid(stems);
  std::vector<Triangle> own = triangles(stems, grid, limits_.triangles);
  index_.sort(own);  // so that the index is walked through once
  Overlayer overlayer(place_.stems, grid_, limits_.alignment);
  std::vector<Overlay> overlays;
  for (const Peak& peak : vote(own, index_, end, limits_.votes))
    overlays.push_back(overlayer.start(stems, peak.T_reference_query, end));
  const auto judge = [&](std::uint32_t step) {
    for (Overlay& o : overlays)
      o.score = overlayer.evidence(stems, density_, coverage_, end, step, o);
    std::stable_sort(overlays.begin(), overlays.end(),
                     [](const Overlay& a, const Overlay& b) { return a.score > b.score; });
  };
  judge(2);
  overlays.resize(std::min(overlays.size(), std::size_t(limits_.finalists)));
  for (Overlay& o : overlays) overlayer.finish(stems, end, o);
  judge(1);
  return overlays;
}

bool Reference::any_good(const Overlay& best) const {
  const Acceptance& accept = limits_.acceptance;
  return best.matches.size() >= std::size_t(accept.min_matches) &&
         best.score >= std::min(accept.min_score, limits_.consensus.supported_score);
}

bool Reference::may_hold(const Place& query, std::size_t node) const {
  const auto stems = stems_around(query, node, limits_.query);
  const auto overlays = hypotheses(stems, std::uint32_t(place_.path.size()));
  return !overlays.empty() && any_good(overlays.front());
}

std::optional<Found> Reference::locate(const Place& query, std::size_t node,
                                       std::uint32_t end) const {
  const std::vector<Stem> stems = stems_around(query, node, limits_.query);
  const std::vector<Overlay> overlays = hypotheses(stems, end);
  const Acceptance& accept = limits_.acceptance;
  if (overlays.empty()) return std::nullopt;
  const Overlay& best = overlays.front();
  if (!any_good(best)) return std::nullopt;
  const std::size_t r = nearest_node(best, end);
  const bool sure = best.score >= accept.min_score &&
                    rival(overlays, r, end) <= (1 - accept.min_margin) * best.score;
  const SE3 T_reference_query = relative_pose(best, stems, query, node, r);
  if (T_reference_query.t.head<2>().norm() > accept.max_distance) return std::nullopt;
  return Found{r, T_reference_query, best.score, sure};
}

}  // namespace tree_match
