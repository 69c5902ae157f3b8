// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <tuple>

#include "cambium/stems.hpp"
#include "model/plan_grid.hpp"

namespace cambium {
namespace {

/// Indices by place. What is summed in this order does not depend on how the places came.
std::vector<std::size_t> by_place(std::span<const Vec3> places) {
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t i) {
    return std::tuple(places[i].x(), places[i].y(), places[i].z(), i);
  };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

/// Ranks (positions in `order`) of the centres, ordered by place.
std::vector<std::size_t> centres(std::span<const Vec3> places,
                                 const std::vector<std::size_t>& order, double radius) {
  PlanGrid all(radius);
  for (std::size_t rank = 0; rank < order.size(); ++rank) all.insert(places[order[rank]], rank);
  std::vector<double> density(order.size(), 0);
  for (std::size_t rank = 0; rank < order.size(); ++rank)
    all.within(places[order[rank]],
               [&](std::size_t, double d) { density[rank] += 1 - d * d / (radius * radius); });
  std::vector<std::size_t> by_density(order.size());
  std::iota(by_density.begin(), by_density.end(), std::size_t{0});
  std::stable_sort(by_density.begin(), by_density.end(),
                   [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });
  std::vector<char> covered(order.size(), 0);
  std::vector<std::size_t> out;
  for (const std::size_t rank : by_density) {
    if (covered[rank]) continue;
    out.push_back(rank);
    all.within(places[order[rank]], [&](std::size_t near, double) { covered[near] = 1; });
  }
  std::sort(out.begin(), out.end());
  return out;
}

PlanGrid grid_of(std::span<const Vec3> places, double radius) {
  PlanGrid grid(radius);
  for (std::size_t i = 0; i < places.size(); ++i) grid.insert(places[i], i);
  return grid;
}

}  // namespace

std::vector<std::vector<std::size_t>> plan_groups(std::span<const Vec3> places, double radius) {
  const auto order = by_place(places);
  const auto ranks = centres(places, order, radius);
  PlanGrid grid(radius);
  for (std::size_t c = 0; c < ranks.size(); ++c) grid.insert(places[order[ranks[c]]], c);
  std::vector<std::vector<std::size_t>> out(ranks.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const auto centre = grid.nearest(places[i])) out[*centre].push_back(i);
  return out;
}

std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(std::span<const Vec3> a,
                                                                std::span<const Vec3> b,
                                                                double radius) {
  const PlanGrid in_a = grid_of(a, radius), in_b = grid_of(b, radius);
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto j = in_b.nearest(a[i]);
    if (j && in_a.nearest(b[*j]) == i) out.push_back({i, *j});
  }
  return out;
}

}  // namespace cambium
