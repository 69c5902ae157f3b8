// SPDX-License-Identifier: BSD-3-Clause
#include "stems.hpp"

#include <array>
#include <cmath>
#include <map>

namespace duplicate_stems {
namespace {

using namespace cambium;
using Point = Eigen::Vector2d;

Point place(const Stem& stem, By by) {
  return (by == By::map ? stem.p_map : stem.p_world).head<2>();
}

/// Points in square cells as wide as the radius of the searches: the nearest one lies in nine
/// cells.
class Grid {
 public:
  explicit Grid(double radius) : radius_(radius) {}

  void insert(const Point& p, std::size_t index) { cells_[cell(p)].push_back({p, index}); }

  /// The nearest point less than the radius away, the first of equals.
  std::optional<std::size_t> nearest(const Point& p) const {
    std::optional<std::size_t> best;
    double best_distance = radius_;
    const auto [x, y] = cell(p);
    for (long i = x - 1; i <= x + 1; ++i)
      for (long j = y - 1; j <= y + 1; ++j) {
        const auto it = cells_.find({i, j});
        if (it == cells_.end()) continue;
        for (const auto& [q, index] : it->second) {
          const double distance = (p - q).norm();
          const bool earlier = best && distance == best_distance && index < *best;
          if (distance < best_distance || earlier) best = index, best_distance = distance;
        }
      }
    return best;
  }

 private:
  std::array<long, 2> cell(const Point& p) const {
    return {std::lround(std::floor(p.x() / radius_)), std::lround(std::floor(p.y() / radius_))};
  }

  double radius_;
  std::map<std::array<long, 2>, std::vector<std::pair<Point, std::size_t>>> cells_;
};

}  // namespace

std::vector<Detection> detections(const MissionView& mission, const Truth& truth,
                                  bool only_reconstructed, const Context& context) {
  std::vector<std::vector<Detection>> by_node(mission.size());
  context.parallel_for(mission.size(), [&](std::size_t n) {
    context.check_cancelled();
    const auto trees = mission.payload(n).trees;
    if (!trees) return;
    const auto& T_world_node = truth.at({mission.index, std::uint32_t(n)});
    for (const Tree& tree : *trees) {
      if ((only_reconstructed && !tree.reconstructed) || !tree.base.allFinite()) continue;
      Detection detection{mission.T_map_node(n) * tree.base, {}};
      if (T_world_node) detection.p_world = *T_world_node * tree.base;
      by_node[n].push_back(detection);
    }
  });
  std::vector<Detection> out;
  for (const auto& found : by_node) out.insert(out.end(), found.begin(), found.end());
  return out;
}

std::vector<Stem> stems(const std::vector<Detection>& detections, By by, double radius,
                        int min_sightings) {
  // A group is looked up where its first detection lies, so that it cannot wander.
  Grid first(radius);
  std::vector<Stem> groups;
  for (const Detection& d : detections) {
    if (by == By::truth && !d.p_world) continue;
    const Point p = by == By::map ? d.p_map.head<2>() : d.p_world->head<2>();
    auto group = first.nearest(p);
    if (!group) {
      group = groups.size();
      groups.emplace_back();
      first.insert(p, *group);
    }
    Stem& stem = groups[*group];
    ++stem.sightings;
    stem.p_map += (d.p_map - stem.p_map) / stem.sightings;
    if (d.p_world) stem.p_world += (*d.p_world - stem.p_world) / stem.sightings;
  }
  std::erase_if(groups, [&](const Stem& s) { return s.sightings < min_sightings; });
  return groups;
}

double Pair::distance(By by) const { return (place(a, by) - place(b, by)).norm(); }

std::vector<Pair> mutual_nearest(const std::vector<Stem>& a, const std::vector<Stem>& b, By by,
                                 double radius) {
  Grid grid_a(radius), grid_b(radius);
  for (std::size_t i = 0; i < a.size(); ++i) grid_a.insert(place(a[i], by), i);
  for (std::size_t i = 0; i < b.size(); ++i) grid_b.insert(place(b[i], by), i);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto j = grid_b.nearest(place(a[i], by));
    if (j && grid_a.nearest(place(b[*j], by)) == i) pairs.push_back({a[i], b[*j]});
  }
  return pairs;
}

}  // namespace duplicate_stems
