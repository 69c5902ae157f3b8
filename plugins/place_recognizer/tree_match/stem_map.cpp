// SPDX-License-Identifier: BSD-3-Clause
#include "stem_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "cambium/path.hpp"
#include "cambium/statistics.hpp"

namespace tree_match {
namespace {

using cambium::Vec3;

/// A stem that is still in view.
struct Track {
  Vec3 recent = Vec3::Zero();  ///< where it was seen lately, from the first node: follows the drift
  double path = 0;             ///< travelled at its last sighting [m]
  double begin = 0;            ///< travelled at its first sighting [m]
  double x_sum = 0, y_sum = 0, weight = 0, dbh_sum = 0, dbh_weight = 0;
  std::vector<double> heights;  ///< where they are known
  std::uint32_t first = 0, last = 0, sightings = 0;
};

constexpr double recent_share = 0.4;

void see(Track& track, const Detection& d, const Vec3& p, double path) {
  track.recent += (track.sightings == 0 ? 1.0 : recent_share) * (p - track.recent);
  const double w = d.weight;
  track.x_sum += w * p.x();
  track.y_sum += w * p.y();
  track.weight += w;
  if (std::isfinite(p.z())) track.heights.push_back(p.z());
  if (d.stem.dbh > 0) {
    track.dbh_sum += w * d.stem.dbh;
    track.dbh_weight += w;
  }
  if (track.sightings++ == 0) {
    track.begin = path;
    track.first = d.stem.first;
  }
  track.path = path;
  track.last = d.stem.first;
}

Stem finished(const Track& t) {
  // The median: some nodes put the same base metres off. NaN when no height is known.
  return {float(t.x_sum / t.weight),
          float(t.y_sum / t.weight),
          float(cambium::median(t.heights)),
          t.dbh_weight > 0 ? float(t.dbh_sum / t.dbh_weight) : 0.0f,
          t.first,
          t.last,
          t.sightings};
}

class Mapper {
 public:
  explicit Mapper(const MapLimits& limits) : limits_(limits) {}

  /// `at`: the node, from the first node [m].
  void add(const Table& table, const Vec3& at, double path) {
    close(path);
    std::vector<Vec3> places;
    for (const Detection& d : table) places.push_back(at + Vec3(d.stem.x, d.stem.y, d.stem.z));
    std::vector<char> assigned(table.size(), 0), taken(open_.size(), 0);
    for (const auto& [distance, d, t] : pairs(places)) {
      if (assigned[d] || taken[t]) continue;
      assigned[d] = taken[t] = 1;
      see(open_[t], table[d], places[d], path);
    }
    for (std::size_t d = 0; d < table.size(); ++d)
      if (!assigned[d]) see(open_.emplace_back(), table[d], places[d], path);
  }

  std::vector<Stem> finish() {
    close(std::numeric_limits<double>::infinity());
    const auto order = [](const Stem& s) { return std::tuple(s.first, s.x, s.y, s.last); };
    std::sort(stems_.begin(), stems_.end(),
              [&](const Stem& a, const Stem& b) { return order(a) < order(b); });
    return std::move(stems_);
  }

 private:
  using Pair = std::tuple<double, std::size_t, std::size_t>;  // distance, detection, track

  /// Nearest first, so that each detection and each track takes the best partner it can have.
  std::vector<Pair> pairs(const std::vector<Vec3>& places) const {
    std::vector<Pair> out;
    for (std::size_t d = 0; d < places.size(); ++d)
      for (std::size_t t = 0; t < open_.size(); ++t) {
        const double distance = (open_[t].recent - places[d]).head<2>().norm();
        if (distance < limits_.radius) out.emplace_back(distance, d, t);
      }
    std::sort(out.begin(), out.end());
    return out;
  }

  /// Finishes what went out of view, and what was in view for long: that goes on as a new stem.
  void close(double path) {
    for (Track& t : open_) {
      const bool whole = t.sightings >= std::uint32_t(limits_.min_sightings);
      const bool in_view = path - t.path <= limits_.revisit;
      if (in_view && !(whole && path - t.begin > limits_.max_track)) continue;
      if (whole) stems_.push_back(finished(t));
      Track next;
      next.recent = t.recent;
      next.path = t.path;
      next.begin = path;
      t = next;
    }
    std::erase_if(open_, [&](const Track& t) { return path - t.path > limits_.revisit; });
  }

  MapLimits limits_;
  std::vector<Track> open_;
  std::vector<Stem> stems_;
};

}  // namespace

std::vector<Stem> stem_map(const cambium::Mission& mission, const std::vector<Table>& tables,
                           const MapLimits& limits, const cambium::Context& context) {
  const std::vector<double> path = cambium::travelled(mission);
  Mapper mapper(limits);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    context.check_cancelled();
    mapper.add(tables[i], mission.nodes[i].T_mission_node.t - mission.nodes[0].T_mission_node.t,
               path[i]);
  }
  return mapper.finish();
}

}  // namespace tree_match
