// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the geometric prior alone: nodes that the current estimate puts close
// together probably saw the same place.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

/// What is kept of a node, in Fingerprints::extra: positions need doubles.
struct Place {
  SE3 T_map_node;
  std::uint64_t island = 0;
};
static_assert(sizeof(Place) == 8 * sizeof(double), "no padding: the bytes are hashed");

std::vector<Place> places(const Fingerprints& fingerprints) {
  std::vector<Place> out(fingerprints.rows);
  if (!out.empty())  // SE3's members have fixed sizes and no pointers: copying bytes copies values
    std::memcpy(static_cast<void*>(out.data()), fingerprints.extra.data(),
                fingerprints.extra.size());
  return out;
}

class SortedByX;

class Proximity final : public PlaceRecognizer {
 public:
  void params(ParamVisitor& v) override {
    v("radius", radius_, "Horizontal distance up to which a pair is proposed", above(0.0, "m"));
    v("radius_growth", radius_growth_,
      "Added to the radius per metre travelled between the two nodes, within a mission",
      between(0.0, 1.0, "m/m"));
    v("max_height_difference", max_height_difference_, "Largest difference in height",
      above(0.0, "m"));
    v("candidates", candidates_, "At most so many proposals for a query, the nearest",
      between(1, 10000));
    v("flat_guess", flat_guess_,
      "The guess keeps the horizontal offset and the heading; height and tilt are taken as equal");
  }

  bool uses_poses() const override { return true; }
  bool yaw_invariant() const override { return true; }

  Fingerprints describe(const MissionView& mission, const Context&) const override {
    Fingerprints out{mission.size(), 0, {}, {}};
    std::vector<Place> rows(mission.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = {mission.T_map_node(i), mission.island()};
    const auto bytes = std::as_bytes(std::span(rows));
    out.extra.assign(bytes.begin(), bytes.end());
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override;

 private:
  /// Horizontal; wider where more drift has gathered between the two nodes.
  double limit(std::size_t query, std::size_t reference, const Pairing& pairing) const {
    if (!pairing.within_mission) return radius_;
    return radius_ +
           radius_growth_ * std::abs(pairing.query_path[query] - pairing.reference_path[reference]);
  }

  SE3 guess(const Place& query, const Place& reference) const;
  std::vector<Candidate> nearest(std::size_t q, const std::vector<Place>& from,
                                 const std::vector<Place>& to, const SortedByX& by_x,
                                 const Pairing& pairing) const;

  double radius_ = 10.0;
  double radius_growth_ = 0.0;
  double max_height_difference_ = 10.0;
  int candidates_ = 5;
  bool flat_guess_ = false;
};

/// References in order of x: all that can be near a query are neighbours in this order.
class SortedByX {
 public:
  explicit SortedByX(const std::vector<Place>& places) : places_(places), order_(places.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t(0));
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t a, std::size_t b) { return x(a) != x(b) ? x(a) < x(b) : a < b; });
  }
  /// The indices of the places with low <= x <= high.
  std::span<const std::size_t> within(double low, double high) const {
    const auto first = std::lower_bound(order_.begin(), order_.end(), low,
                                        [&](std::size_t i, double v) { return x(i) < v; });
    const auto last = std::upper_bound(first, order_.end(), high,
                                       [&](double v, std::size_t i) { return v < x(i); });
    return {first, last};
  }

 private:
  double x(std::size_t i) const { return places_[i].T_map_node.t.x(); }

  const std::vector<Place>& places_;
  std::vector<std::size_t> order_;
};

SE3 heading_only(const SE3& T) { return SE3::from_yaw(T.yaw(), {T.t.x(), T.t.y(), 0.0}); }

SE3 Proximity::guess(const Place& query, const Place& reference) const {
  if (!flat_guess_) return reference.T_map_node.inverse() * query.T_map_node;
  return heading_only(reference.T_map_node).inverse() * heading_only(query.T_map_node);
}

std::vector<Candidate> Proximity::nearest(std::size_t q, const std::vector<Place>& from,
                                          const std::vector<Place>& to, const SortedByX& by_x,
                                          const Pairing& pairing) const {
  // The path grows with the node, so the largest radius belongs to the first or the last one.
  const double widest = std::max(limit(q, 0, pairing), limit(q, to.size() - 1, pairing));
  const double x = from[q].T_map_node.t.x();
  std::vector<Candidate> out;
  for (const std::size_t r : by_x.within(x - widest, x + widest)) {
    const Vec3 offset = to[r].T_map_node.t - from[q].T_map_node.t;
    if (offset.head<2>().norm() > limit(q, r, pairing)) continue;
    if (std::abs(offset.z()) > max_height_difference_ || !pairing.allowed(q, r)) continue;
    out.push_back({q, r, -offset.norm(), guess(from[q], to[r])});
  }
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.score != b.score ? a.score > b.score : a.reference < b.reference;
  });
  if (out.size() > std::size_t(candidates_)) out.resize(std::size_t(candidates_));
  return out;
}

std::vector<Candidate> Proximity::match(const Fingerprints& query, const Fingerprints& reference,
                                        const Pairing& pairing, const Context& context) const {
  const std::vector<Place> from = places(query), to = places(reference);
  // Other islands have their own map frame: there, distances mean nothing.
  if (from.empty() || to.empty() || from.front().island != to.front().island) return {};
  const SortedByX by_x(to);
  std::vector<std::vector<Candidate>> of_query(from.size());
  context.parallel_for(from.size(), [&](std::size_t q) {
    context.check_cancelled();
    of_query[q] = nearest(q, from, to, by_x, pairing);
  });
  std::vector<Candidate> out;
  for (const auto& found : of_query) out.insert(out.end(), found.begin(), found.end());
  return out;
}

}  // namespace

CAMBIUM_PLUGIN("proximity", "0.1.0") {
  registry.add<Proximity>("proximity", "Nodes that the current estimate puts close together");
}
