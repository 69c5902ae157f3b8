// SPDX-License-Identifier: BSD-3-Clause
// Where a node of one mission stands in another.
#pragma once
#include <optional>

#include "alignment.hpp"
#include "fingerprint.hpp"

namespace tree_match {

struct QueryLimits {
  double window = 20.0;  ///< stems seen from nodes up to so far along the path [m]
  double range = 50.0;   ///< and at most so far from the query's node [m]
  int max_stems = 250;   ///< the nearest ones
};

/// The stems around a node, from the node, along the mission's axes.
std::vector<Stem> stems_around(const Place& place, std::size_t node, const QueryLimits& limits);

constexpr double same_yaw = 0.35;  ///< poses that are turned by more are not the same [rad]

struct Acceptance {
  int min_matches = 16;     ///< stems that lie on one another
  double min_score = 8.0;   ///< least log likelihood ratio
  double min_margin = 0.4;  ///< share of it by which any other place stays below it
  double distinct = 3.0;    ///< hypotheses nearer than this are the same place [m]
  double drift = 0.05;      ///< two passes of one place may lie so far apart, of the path between
  double max_distance = 35.0;  ///< of two nodes: a turn that is slightly wrong grows with it [m]
};

struct ConsensusLimits {
  double support_window = 30.0;  ///< neighbours that support, up to so far along the path [m]
  int min_support = 2;           ///< sure neighbours that must agree with an answer that is not
  double supported_score = 0.0;  ///< its least log likelihood ratio
  double window = 300.0;         ///< neighbours that contradict, and that say how high it is [m]
  double agree = 1.0;            ///< apart, two answers mean one place of the mission [m]
  double agree_yaw = 0.05;       ///< [rad]
};

struct Limits {
  QueryLimits query;
  TriangleLimits triangles;
  IndexLimits index;
  VoteLimits votes;
  AlignmentLimits alignment;
  Acceptance acceptance;
  ConsensusLimits consensus;
  int finalists = 20;         ///< hypotheses that are refined to the end
  double table_radius = 1.0;  ///< how far the map may have drifted from a node [m]
  int table_matches = 10;     ///< stems that two nodes must both have seen to refine on those
  double sigma_tilt = 0.01;   ///< of gravity in the missions' frames [rad]
};

struct Found {
  std::size_t reference = 0;  ///< node
  cambium::SE3 T_reference_query;
  double score = 0;  ///< log likelihood ratio
  bool sure = true;  ///< keeps `min_score` and `min_margin`; else neighbours must agree with it
};

/// A mission in which places are looked for. One instance serves all threads.
class Reference {
 public:
  Reference(Place place, const Limits& limits);
  const Place& place() const { return place_; }  ///< without its triangles: the index has them

  /// `end`: only nodes before it, and stems last seen before it, count. Nothing when no hypothesis
  /// could be accepted.
  std::optional<Found> locate(const Place& query, std::size_t node, std::uint32_t end) const;

  /// Whether the node's best hypothesis is one that could be accepted if its neighbours bore it
  /// out.
  bool may_hold(const Place& query, std::size_t node) const;

 private:
  std::vector<Overlay> hypotheses(std::span<const Stem> stems, std::uint32_t end) const;
  bool any_good(const Overlay& best) const;
  std::size_t nearest_node(const Overlay& overlay, std::uint32_t end) const;
  double rival(const std::vector<Overlay>& overlays, std::size_t node, std::uint32_t end) const;
  cambium::SE3 relative_pose(const Overlay& overlay, std::span<const Stem> stems,
                             const Place& query, std::size_t q, std::size_t r) const;

  Limits limits_;
  Place place_;
  StemGrid grid_;
  std::vector<float> density_;
  Coverage coverage_;
  TriangleIndex index_;
};

}  // namespace tree_match
