// SPDX-License-Identifier: BSD-3-Clause
// Place recognition by the geometric prior alone: nodes that the current estimate puts close
// together probably saw the same place.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "cambium/plugin.hpp"

namespace {

using namespace cambium;

/// What is kept of a node, in Fingerprints::extra: positions need doubles.
struct Place {
  SE3 T_map_node;
  double path = 0;  ///< travelled since the start of the mission [m]
  std::uint64_t island = 0;
};
static_assert(sizeof(Place) == 9 * sizeof(double), "no padding: the bytes are hashed");

std::vector<Place> places(const Fingerprints& fingerprints) {
  std::vector<Place> out(fingerprints.rows);
  if (!out.empty())  // SE3's members have fixed sizes and no pointers: copying bytes copies values
    std::memcpy(static_cast<void*>(out.data()), fingerprints.extra.data(),
                fingerprints.extra.size());
  return out;
}

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
  }

  bool uses_poses() const override { return true; }
  bool yaw_invariant() const override { return true; }

  Fingerprints describe(const MissionView& mission, const Context&) const override {
    Fingerprints out{mission.size(), 0, {}, {}};
    std::vector<Place> rows(mission.size());
    double path = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto& nodes = mission.mission().nodes;
      // The robot's own estimate: the path's length must not change with loop closures.
      if (i > 0) path += (nodes[i].T_mission_node.t - nodes[i - 1].T_mission_node.t).norm();
      rows[i] = {mission.T_map_node(i), path, mission.island()};
    }
    const auto bytes = std::as_bytes(std::span(rows));
    out.extra.assign(bytes.begin(), bytes.end());
    return out;
  }

  std::vector<Candidate> match(const Fingerprints& query, const Fingerprints& reference,
                               const Pairing& pairing, const Context& context) const override;

 private:
  double limit(const Place& query, const Place& reference, const Pairing& pairing) const {
    const double travelled = std::abs(query.path - reference.path);
    return radius_ + (pairing.within_mission ? radius_growth_ * travelled : 0.0);
  }

  double radius_ = 10.0;
  double radius_growth_ = 0.0;
  double max_height_difference_ = 10.0;
  int candidates_ = 5;
};

/// References in order of x: all that can be near a query are neighbours in this order.
class SortedByX {
 public:
  explicit SortedByX(const std::vector<Place>& places) : places_(places), order_(places.size()) {
    for (std::size_t i = 0; i < order_.size(); ++i) order_[i] = i;
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

std::vector<Candidate> Proximity::match(const Fingerprints& query, const Fingerprints& reference,
                                        const Pairing& pairing, const Context& context) const {
  const std::vector<Place> from = places(query), to = places(reference);
  // Other islands have their own map frame: there, distances mean nothing.
  if (from.empty() || to.empty() || from.front().island != to.front().island) return {};
  const SortedByX index(to);
  std::vector<std::vector<Candidate>> nearest(from.size());
  context.parallel_for(from.size(), [&](std::size_t q) {
    context.check_cancelled();
    const Place& a = from[q];
    const double widest = std::max(limit(a, to.front(), pairing), limit(a, to.back(), pairing));
    const double x = a.T_map_node.t.x();
    for (const std::size_t r : index.within(x - widest, x + widest)) {
      const Vec3 d = to[r].T_map_node.t - a.T_map_node.t;
      const double distance = d.head<2>().norm();
      if (distance > limit(a, to[r], pairing) || std::abs(d.z()) > max_height_difference_ ||
          !pairing.allowed(q, r))
        continue;
      nearest[q].push_back({q, r, -d.norm(), to[r].T_map_node.inverse() * a.T_map_node});
    }
    std::sort(nearest[q].begin(), nearest[q].end(), [](const Candidate& l, const Candidate& h) {
      return l.score != h.score ? l.score > h.score : l.reference < h.reference;
    });
    if (nearest[q].size() > std::size_t(candidates_)) nearest[q].resize(std::size_t(candidates_));
  });
  std::vector<Candidate> out;
  for (const auto& of_query : nearest) out.insert(out.end(), of_query.begin(), of_query.end());
  return out;
}

}  // namespace

CAMBIUM_PLUGIN("proximity", "0.1.0") {
  registry.add<Proximity>("proximity", "Nodes that the current estimate puts close together");
}
