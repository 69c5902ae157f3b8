// SPDX-License-Identifier: BSD-3-Clause
#include "overlay.hpp"

#include <cmath>
#include <numbers>

#include "cambium/fit.hpp"
#include "cambium/statistics.hpp"

namespace canopy_match {
namespace {

using cambium::SE3;
using cambium::Vec3;

struct Pairs {
  std::vector<Vec3> reference, query;
};

/// One to one: of several query trees on one reference tree the nearest stays.
Pairs match(std::span<const Vec3> reference, const Neighbours& of_reference,
            std::span<const Vec3> query, const SE3& T, double radius) {
  std::map<std::size_t, std::pair<double, std::size_t>> best;  // reference -> distance, query
  for (std::size_t q = 0; q < query.size(); ++q) {
    const Vec3 p = T * query[q];
    const std::size_t r = of_reference.nearest(p, radius);
    if (r == Neighbours::none) continue;
    const double d = (reference[r] - p).head<2>().norm();
    const auto [it, fresh] = best.try_emplace(r, d, q);
    if (!fresh && d < it->second.first) it->second = {d, q};
  }
  Pairs out;
  for (const auto& [r, found] : best) {
    out.reference.push_back(reference[r]);
    out.query.push_back(query[found.second]);
  }
  return out;
}

double median_lift(const Pairs& pairs) {
  std::vector<double> dz;
  for (std::size_t i = 0; i < pairs.query.size(); ++i)
    dz.push_back(pairs.reference[i].z() - pairs.query[i].z());
  return cambium::median(dz);
}

/// Of so many seen trees by chance each matches with probability p; the likelihood ratio of the
/// share that does (the binomial's divergence, as in Chernoff's bound).
double log_likelihood_ratio(double matches, double seen, double p) {
  const double share = matches / seen;
  if (share <= p) return 0;
  const double hits = matches * std::log(share / p);
  return matches < seen ? hits + (seen - matches) * std::log((1 - share) / (1 - p)) : hits;
}

void judge(std::span<const Vec3> reference, std::span<const Vec3> query,
           const OverlayLimits& limits, Overlay& overlay) {
  const Neighbours wide(reference, limits.cover);
  std::vector<Vec3> seen;
  for (const Vec3& tree : query) {
    const Vec3 p = overlay.T_reference_query * tree;
    if (wide.nearest(p, limits.cover) != Neighbours::none) seen.push_back(p);
  }
  overlay.seen = seen.size();
  if (seen.empty()) return;
  // The density of the reference where it was looked at: trees near the seen ones, over the area
  // that those cover.
  const Neighbours around(seen, limits.cover);
  double near = 0, sampled = 0, covered = 0;
  for (const Vec3& r : reference) near += around.nearest(r, limits.cover) != Neighbours::none;
  Vec3 low = seen[0], high = seen[0];
  for (const Vec3& p : seen) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const double step = limits.cover / 4;
  for (double x = low.x() - limits.cover; x <= high.x() + limits.cover; x += step)
    for (double y = low.y() - limits.cover; y <= high.y() + limits.cover; y += step)
      ++sampled, covered += around.nearest({x, y, 0}, limits.cover) != Neighbours::none;
  const double density = near / std::max(1.0, covered * step * step);
  const double p = 1 - std::exp(-density * std::numbers::pi * limits.radius * limits.radius);
  overlay.score = log_likelihood_ratio(double(std::min(overlay.matches, overlay.seen)),
                                       double(overlay.seen), std::clamp(p, 1e-6, 1 - 1e-6));
}

}  // namespace

Neighbours::Neighbours(std::span<const Vec3> trees, double cell) : trees_(trees), cell_(cell) {
  for (std::size_t i = 0; i < trees.size(); ++i)
    cells_[{std::lround(trees[i].x() / cell), std::lround(trees[i].y() / cell)}].push_back(i);
}

std::size_t Neighbours::nearest(const Vec3& p, double radius) const {
  std::size_t best = none;
  double least = radius;
  const long x = std::lround(p.x() / cell_), y = std::lround(p.y() / cell_);
  for (long dx = -1; dx <= 1; ++dx)
    for (long dy = -1; dy <= 1; ++dy) {
      const auto it = cells_.find({x + dx, y + dy});
      if (it == cells_.end()) continue;
      for (const std::size_t i : it->second) {
        const double d = (trees_[i] - p).head<2>().norm();
        if (d < least) least = d, best = i;
      }
    }
  return best;
}

Overlay lay_over(std::span<const Vec3> reference, const Neighbours& of_reference,
                 std::span<const Vec3> query, const SE3& start, const OverlayLimits& limits) {
  constexpr int iterations = 10;
  Overlay out;
  out.T_reference_query = start;
  Pairs pairs;
  for (int i = 0; i < iterations; ++i) {
    const double radius = i < iterations / 2 ? limits.coarse_radius : limits.radius;
    pairs = match(reference, of_reference, query, out.T_reference_query, radius);
    if (pairs.query.size() < 3) return Overlay{start, 0, 0, 0, 0};
    out.T_reference_query = cambium::fit_yaw(pairs.reference, pairs.query);
  }
  out.T_reference_query.t.z() = median_lift(pairs);
  out.matches = pairs.query.size();
  double squares = 0;
  for (std::size_t i = 0; i < pairs.query.size(); ++i)
    squares +=
        (pairs.reference[i] - out.T_reference_query * pairs.query[i]).head<2>().squaredNorm();
  out.rmse = std::sqrt(squares / double(out.matches));
  judge(reference, query, limits, out);
  return out;
}

}  // namespace canopy_match
