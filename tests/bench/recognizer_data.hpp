// SPDX-License-Identifier: BSD-3-Clause
// Two missions (or two halves of one) whose true poses are known in one frame.
#pragma once
#include "support/support.hpp"

namespace cambium::bench {

struct Scene {
  std::string name;
  Atlas atlas;                        ///< the reference is mission 0, the query mission 1
  std::vector<SE3> query, reference;  ///< true T_world_node

  double distance(std::size_t q, std::size_t r) const {
    return (query[q].t - reference[r].t).norm();
  }
  double nearest(std::size_t q) const;  ///< to the next reference [m]
  /// Seen from the nearest reference's place, at most 6 m on: passing beside at 20 m, any reference
  /// within 20.9 m.
  bool is_right(const Candidate& c) const;
};

/// "QUERY,REFERENCE": mission folders with ground_truth.tum. "MISSION,K": every K-th node is the
/// reference, the others are queries that are turned by 77 degrees each; without ground_truth.tum
/// the mission's own poses count as true, which are good over some metres.
Scene load_scene(const std::string& what, const Context& context);

/// The scene with each payload filtered by "NAME" or "NAME{PARAMS}".
Scene filtered(const Scene& scene, const std::string& filter, const Context& context);

/// "NAME{PARAMS}" or "NAME" apart.
std::pair<std::string, std::string> name_and_params(const std::string& what);

}  // namespace cambium::bench
