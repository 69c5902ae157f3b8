// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/stems.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cambium/statistics.hpp"

namespace cambium {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A tree as one node detected it, in the map frame.
struct Detection {
  NodeRef node;
  Tree tree;
};

std::vector<Detection> detections_of(const MissionView& mission, bool only_reconstructed,
                                     const Context& context) {
  std::vector<std::vector<Detection>> by_node(mission.size());
  context.expect(mission.size());  // a filter may look for trees only now
  context.parallel_for(mission.size(), [&](std::size_t n) {
    context.check_cancelled();
    const auto trees = mission.payload(n).trees;
    context.advance();
    if (!trees) return;
    const SE3& T = mission.T_map_node(n);
    for (const Tree& seen : *trees) {
      if ((only_reconstructed && !seen.reconstructed) || !seen.base.allFinite()) continue;
      Tree tree = seen;
      tree.base = T * seen.base;
      tree.axis = T.q * seen.axis;
      by_node[n].push_back({{mission.index, std::uint32_t(n)}, tree});
    }
  });
  std::vector<Detection> out;
  for (const auto& found : by_node) out.insert(out.end(), found.begin(), found.end());
  return out;
}

double spread(const std::vector<double>& values) {
  if (values.size() < 2) return unknown;
  double mean = 0, sum = 0;
  for (const double v : values) mean += v / double(values.size());
  for (const double v : values) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / double(values.size() - 1));
}

/// Huber's location with his constant for 95 % efficiency; the scale is the median deviation.
double huber(const std::vector<double>& sorted) {
  double location = median(sorted);
  std::vector<double> deviations;
  for (const double v : sorted) deviations.push_back(std::abs(v - location));
  const double limit = 1.345 * 1.4826 * median(deviations);
  if (!(limit > 0)) return location;
  for (int i = 0; i < 50; ++i) {
    double sum = 0, weights = 0;
    for (const double v : sorted) {
      const double w = std::min(1.0, limit / std::max(limit, std::abs(v - location)));
      sum += w * v;
      weights += w;
    }
    const double next = sum / weights;
    if (std::abs(next - location) < 1e-9) break;
    location = next;
  }
  return location;
}

void set_diameter(Stem& stem, std::vector<double> measured) {
  std::sort(measured.begin(), measured.end());
  stem.dbh = measured.empty() ? unknown : huber(measured);
  stem.dbh_spread = spread(measured);
  stem.dbh_sigma = stem.dbh_spread / std::sqrt(double(measured.size()));
}

Stem stem_of(std::vector<const Detection*> seen) {
  // In the order of the values: sums must not depend on the order of missions.
  std::sort(seen.begin(), seen.end(), [](const Detection* a, const Detection* b) {
    return std::tie(a->tree.base.x(), a->tree.base.y(), a->tree.base.z(), a->tree.dbh) <
           std::tie(b->tree.base.x(), b->tree.base.y(), b->tree.base.z(), b->tree.dbh);
  });
  Stem stem;
  std::vector<double> diameters, along[3];
  Vec3 axis = Vec3::Zero();
  for (const Detection* d : seen) {
    for (int k = 0; k < 3; ++k) along[k].push_back(d->tree.base[k]);
    if (std::isfinite(d->tree.dbh)) diameters.push_back(d->tree.dbh);
    if (d->tree.axis.allFinite()) axis += d->tree.axis;
    stem.score += d->tree.score / double(seen.size());
    stem.seen_by.push_back(d->node);
  }
  for (int k = 0; k < 3; ++k) {
    stem.base[k] = median(along[k]);
    stem.base_spread[k] = spread(along[k]);
  }
  if (axis.norm() > 1e-9) stem.axis = axis.normalized();
  set_diameter(stem, diameters);
  std::sort(stem.seen_by.begin(), stem.seen_by.end());
  stem.seen_by.erase(std::unique(stem.seen_by.begin(), stem.seen_by.end()), stem.seen_by.end());
  return stem;
}

}  // namespace

std::vector<std::uint32_t> Stem::missions() const {
  std::vector<std::uint32_t> out;
  for (const NodeRef& n : seen_by)
    if (out.empty() || out.back() != n.mission) out.push_back(n.mission);
  return out;
}

std::vector<Stem> stems_of(const Atlas& atlas, const std::vector<std::uint32_t>& missions,
                           const StemOptions& options, const Context& context) {
  std::vector<Detection> all;
  for (const std::uint32_t m : missions) {
    const auto found = detections_of({atlas, m}, options.only_reconstructed, context);
    all.insert(all.end(), found.begin(), found.end());
  }
  std::vector<Vec3> places;
  for (const Detection& d : all) places.push_back(d.tree.base);
  std::vector<Stem> out;
  for (const auto& group : plan_groups(places, options.radius)) {
    context.check_cancelled();
    std::vector<const Detection*> seen;
    for (const std::size_t i : group) seen.push_back(&all[i]);
    Stem stem = stem_of(std::move(seen));
    if (stem.seen_by.size() >= std::size_t(options.min_sightings)) out.push_back(std::move(stem));
  }
  std::sort(out.begin(), out.end(), [](const Stem& a, const Stem& b) {
    return std::tie(a.base.x(), a.base.y()) < std::tie(b.base.x(), b.base.y());
  });
  return out;
}

}  // namespace cambium
