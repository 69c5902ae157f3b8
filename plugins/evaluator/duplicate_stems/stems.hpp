// SPDX-License-Identifier: BSD-3-Clause
// The trees that each mission found, and which of them two missions share.
#pragma once
#include <vector>

#include "cambium/context.hpp"
#include "cambium/truth.hpp"

namespace duplicate_stems {

using cambium::Vec3;

/// A tree as one node detected it.
struct Detection {
  Vec3 p_map;                   ///< base under the fused pose of the node
  std::optional<Vec3> p_world;  ///< base under its true pose
};

/// The reconstructed trees of a mission, or all detections, in order of nodes and tables.
std::vector<Detection> detections(const cambium::MissionView& mission, const cambium::Truth& truth,
                                  bool only_reconstructed, const cambium::Context& context);

/// A tree of a mission: the mean of its detections.
struct Stem {
  Vec3 p_map = Vec3::Zero(), p_world = Vec3::Zero();
  int sightings = 0;
};

enum class By { map, truth };

/// Groups detections as an inventory does (plan_groups), in the map or by the truth (then those
/// without a true pose are left out); keeps groups of at least `min_sightings`.
std::vector<Stem> stems(const std::vector<Detection>& detections, By by, double radius,
                        int min_sightings);

struct Pair {
  Stem a, b;
  double distance(By by) const;  ///< horizontal [m]
};

/// Stems of two missions that are each other's nearest, less than `radius` [m] apart.
std::vector<Pair> shared(const std::vector<Stem>& a, const std::vector<Stem>& b, By by,
                         double radius);

}  // namespace duplicate_stems
