// SPDX-License-Identifier: BSD-3-Clause
// The trees of a map: what all nodes of all missions detected, each tree once.
#pragma once
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"

namespace cambium {

/// Groups places that lie within `radius` [m] of a common centre on the plan (x, y). Centres are
/// where places are densest (Epanechnikov's kernel), no two nearer than `radius`; every place
/// belongs to the nearest one. Groups are ordered by their centres' x, then y; indices within a
/// group ascend. The grouping depends on the places, not on their order. Places must be finite.
std::vector<std::vector<std::size_t>> plan_groups(std::span<const Vec3> places, double radius);

/// Pairs (index in a, index in b) that are each other's nearest on the plan and less than `radius`
/// [m] apart, ascending in the first.
std::vector<std::pair<std::size_t, std::size_t>> mutual_nearest(std::span<const Vec3> a,
                                                                std::span<const Vec3> b,
                                                                double radius);

struct StemOptions {
  double radius = 0.5;             ///< detections so near each other are one tree [m]
  int min_sightings = 3;           ///< a tree was detected at so many nodes
  bool only_reconstructed = true;  ///< leave out detections without a stem model
};

/// A tree of the map.
struct Stem {
  Vec3 base = Vec3::Zero();         ///< in the map frame; the median of its detections per axis [m]
  Vec3 base_spread = Vec3::Zero();  ///< standard deviation of its detections per axis [m]
  Vec3 axis = Vec3::UnitZ();        ///< unit vector up along the stem, in the map frame
  double dbh = 0;                ///< diameter at breast height [m]; NaN when it was never measured
  double dbh_spread = 0;         ///< standard deviation of its measurements [m]; NaN below two
  double dbh_sigma = 0;          ///< standard error of dbh if they err independently [m]
  double score = 0;              ///< mean of the detections' scores, 0..1
  std::vector<NodeRef> seen_by;  ///< nodes that detected it, ascending

  std::vector<std::uint32_t> missions() const;  ///< that saw it, ascending
};

/// The trees that these missions saw, which must share a map frame; ordered by x, then y. The
/// diameter is Huber's estimate of location (Huber 1964) over the measurements. Throws Error(data)
/// when a payload cannot be read.
std::vector<Stem> stems_of(const Atlas& atlas, const std::vector<std::uint32_t>& missions,
                           const StemOptions& options, const Context& context);

}  // namespace cambium
