// SPDX-License-Identifier: BSD-3-Clause
// All missions, what ties them together, and where they are. A step takes one and returns another.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cambium/mission.hpp"

namespace cambium {

/// A node by its place in the atlas: mission index, node index.
struct NodeRef {
  std::uint32_t mission = 0, node = 0;
  friend auto operator<=>(const NodeRef&, const NodeRef&) = default;
};

enum class LoopState { candidate, registered, accepted, rejected };
const char* to_string(LoopState state);

/// A pair of nodes that may have seen the same place, from its proposal to its verdict.
/// This is one row of the ledger.
struct Loop {
  NodeRef tail, head;     ///< tail < head; tail is the target of the registration
  LoopState state = LoopState::candidate;
  bool has_guess = false;  ///< T_tail_head holds the recogniser's guess
  SE3 T_tail_head;         ///< guess, then the registered transform
  Mat6 information = Mat6::Identity();  ///< of the registered transform
  std::vector<Score> scores;
  std::string proposed_by, registered_by, decided_by;  ///< plugin names; empty = not reached
  std::string reason;         ///< why it was accepted or rejected
  double weight = 1.0;        ///< of the last optimisation, 0..1
  Vec6 residual = Vec6::Zero();  ///< of the last optimisation: [m; rad]
};

/// A mission in the map frame of its island.
struct MissionState {
  std::shared_ptr<const Mission> mission;
  std::shared_ptr<const std::vector<SE3>> T_map_node;  ///< one per node
  std::uint32_t island = 0;
  NodeId id_offset = 0;  ///< a node's id in the fused graph is id + id_offset
};

/// Where a node is by what is known outside of the map (GNSS), in the map frame of its island.
struct NodePosition {
  NodeRef node;
  Vec3 t_map = Vec3::Zero();
  Mat3 information = Mat3::Identity();
};

/// Missions that are tied together. They share one map frame and one georeference.
struct Island {
  std::vector<std::uint32_t> missions;       ///< ascending
  std::optional<GeoReference> georeference;  ///< replaces those of its missions
  std::vector<NodePosition> positions = {};  ///< made with the georeference, for the optimisation
};

/// Where an `optimize` step left the missions.
struct Stage {
  std::string step;  ///< the step's plugin
  std::vector<std::shared_ptr<const std::vector<SE3>>> T_map_node;  ///< one list a mission
  std::vector<std::uint32_t> islands;  ///< of each mission then: its poses are in that one's frame
};

using PayloadSources = std::vector<std::vector<std::shared_ptr<const PayloadSource>>>;

struct Atlas {
  std::vector<MissionState> missions;  ///< ordered by name
  std::vector<Loop> loops;             ///< ordered by (tail, head)
  std::vector<Island> islands;
  std::shared_ptr<const PayloadSources> payloads;  ///< [mission][node], after the filters
  std::vector<Stage> stages = {};                  ///< one an optimisation so far; for looking back

  const Mission& mission(NodeRef n) const { return *missions[n.mission].mission; }
  const Node& node(NodeRef n) const { return mission(n).nodes[n.node]; }
  const SE3& T_map_node(NodeRef n) const { return (*missions[n.mission].T_map_node)[n.node]; }
  Payload payload(NodeRef n) const;  ///< empty when the node has none; throws Error(data)
};

/// One mission of an atlas, the way recognisers and filters look at it.
struct MissionView {
  const Atlas& atlas;
  std::uint32_t index = 0;

  const Mission& mission() const { return *atlas.missions[index].mission; }
  std::size_t size() const { return mission().nodes.size(); }
  std::uint32_t island() const { return atlas.missions[index].island; }
  const SE3& T_map_node(std::size_t i) const { return (*atlas.missions[index].T_map_node)[i]; }
  Payload payload(std::size_t i) const { return atlas.payload({index, std::uint32_t(i)}); }
};

}  // namespace cambium
