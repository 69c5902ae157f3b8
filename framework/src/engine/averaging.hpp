// SPDX-License-Identifier: BSD-3-Clause
// The frames of many rigid bodies from what is known between pairs of them, all at once.
#pragma once
#include <cstdint>
#include <vector>

#include "engine/pair_fit.hpp"

namespace cambium {

/// A measurement between two bodies.
struct BodyPair {
  std::uint32_t first = 0, second = 0;
  PairFit fit;
  double tolerance = 1;  ///< by which it may be off because bodies are not quite rigid [m]
  double weight = 1;     ///< how much it counts beside other pairs

  bool used = true;  ///< result: false when it contradicts the others
  double off = 0;    ///< result: how far the frames leave it unfulfilled, rms [m]
};

/// The frame of each body, T_root_body, and its root: the first body that pairs tie it to.
struct BodyFrames {
  std::vector<std::uint32_t> root;
  std::vector<SE3> T_root_body;
};

/// Minimises the sum of weight * min((off / tolerance)^2, 1) over all pairs, so that no pair, and
/// no tree of pairs, decides alone: rotations by the chordal relaxation and translations given
/// them, both linear (Carlone et al., ICRA 2015), inside graduated non-convexity (Yang et al.,
/// RA-L 2020). Nothing depends on a starting point. Pairs that hold bodies together stay in use
/// whatever they say; among pairs that contradict one another without a majority the heavier ones
/// stay, then the first by their order. Bodies without pairs are their own roots.
BodyFrames average_frames(std::size_t bodies, std::vector<BodyPair>& pairs);

}  // namespace cambium
