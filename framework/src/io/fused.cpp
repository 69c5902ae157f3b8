// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/fused.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"

namespace cambium {
namespace {

std::string pose_fields(const SE3& T) {
  std::string out;
  for (int i = 0; i < 3; ++i) out += ' ' + format_number(T.t[i]);
  for (int i = 0; i < 4; ++i) out += ' ' + format_number(T.q.coeffs()[i]);  // x y z w
  return out;
}

/// Builds the joint graph, one mission after another.
class Fusion {
 public:
  explicit Fusion(const Atlas& atlas) : atlas_(atlas) {}

  void add_mission(const MissionState& state) {
    const bool anchors = fused_.nodes.empty();
    describe(state);
    add_nodes(state, anchors);
    for (Edge edge : state.mission->edges) add_edge(state, std::move(edge));
    for (const RawLine& raw : state.mission->unknown_lines) {
      const std::size_t text = raw.text.find_first_not_of("# ");
      if (text != std::string::npos) comment(state.mission->name + ": " + raw.text.substr(text));
    }
  }

  void add_loop(const Loop& loop) {
    Edge edge;
    edge.kind = EdgeKind::loop;
    edge.tail = id(loop.tail);
    edge.head = id(loop.head);
    edge.T_tail_head = loop.T_tail_head;
    edge.information = loop.information;
    edge.tag = "EDGE_SE3:QUAT";
    // A comment, because scaling the information would make the weight count twice next time.
    if (loop.weight != 1)
      comment(
          fmt::format("LOOP_WEIGHT {} {} {}", edge.tail, edge.head, format_number(loop.weight)));
    fused_.edges.push_back(std::move(edge));
  }

  Mission finish(const Island& island) && {
    std::sort(fused_.nodes.begin(), fused_.nodes.end(),
              [](const Node& a, const Node& b) { return a.id < b.id; });
    const auto twice =
        std::adjacent_find(fused_.nodes.begin(), fused_.nodes.end(),
                           [](const Node& a, const Node& b) { return a.id == b.id; });
    if (twice != fused_.nodes.end())
      throw Error(ErrorCode::data, "",
                  fmt::format("two missions have a node {} in the fused numbering; expected id "
                              "offsets that keep them apart",
                              twice->id));
    fused_.name = "fused";
    fused_.georeference = georeference(atlas_, island);
    const auto platform = [&](std::uint32_t m) { return atlas_.missions[m].mission->platform_id; };
    const int first = platform(island.missions.front());
    if (std::all_of(island.missions.begin(), island.missions.end(),
                    [&](std::uint32_t m) { return platform(m) == first; }))
      fused_.platform_id = first;
    return std::move(fused_);
  }

 private:
  void comment(std::string text) { fused_.unknown_lines.push_back({0, "# " + std::move(text)}); }

  NodeId id(NodeRef n) const { return atlas_.node(n).id + atlas_.missions[n.mission].id_offset; }

  void describe(const MissionState& state) {
    const Mission& mission = *state.mission;
    comment(fmt::format("MISSION {} PLATFORM_ID {} ID_OFFSET {} NODES {}", mission.name,
                        mission.platform_id, state.id_offset, mission.nodes.size()));
    if (!mission.georeference) return;
    const GeoReference& g = *mission.georeference;
    comment(fmt::format("{}: GNSS_LLA_REF {} {} {}", mission.name, format_number(g.latitude),
                        format_number(g.longitude), format_number(g.altitude)));
    comment(mission.name + ": GNSS_LLA_TO_MAP" + pose_fields(g.T_map_enu));
  }

  void add_nodes(const MissionState& state, bool anchors) {
    for (std::size_t i = 0; i < state.mission->nodes.size(); ++i) {
      Node node = state.mission->nodes[i];
      if (node.fixed && !anchors) {
        comment(fmt::format("{}: FIX {}", state.mission->name, node.id + state.id_offset));
        node.fixed = false;
      }
      node.id += state.id_offset;
      node.T_mission_node = (*state.T_map_node)[i];
      node.line = 0;
      fused_.nodes.push_back(std::move(node));
    }
  }

  void add_edge(const MissionState& state, Edge edge) {
    edge.tail += state.id_offset;
    edge.head += state.id_offset;
    edge.line = 0;
    if (edge.kind == EdgeKind::prior || edge.kind == EdgeKind::position) {
      const SE3 T = T_map_mission(state);
      const Mat3 R = T.rotation();
      edge.T_tail_head = T * edge.T_tail_head;
      // The position error is expressed in the frame of the prior, and turns with it; the rotation
      // error is expressed at the node, and does not.
      Mat6 J = Mat6::Identity();
      J.topLeftCorner<3, 3>() = R;
      edge.information = J * edge.information.eval() * J.transpose();
      edge.tag.clear();  // an unary edge of our own: the offsets of EDGE_SE3_PRIOR are per file
      edge.extra.clear();
    }
    fused_.edges.push_back(std::move(edge));
  }

  const Atlas& atlas_;
  Mission fused_;
};

}  // namespace

Mission fused_mission(const Atlas& atlas, const Island& island) {
  Fusion fusion(atlas);
  for (const std::uint32_t m : island.missions) fusion.add_mission(atlas.missions[m]);
  const auto in_island = [&](NodeRef n) {
    return std::binary_search(island.missions.begin(), island.missions.end(), n.mission);
  };
  for (const Loop& loop : atlas.loops) {
    if (loop.state == LoopState::accepted && in_island(loop.tail) && in_island(loop.head))
      fusion.add_loop(loop);
  }
  return std::move(fusion).finish(island);
}

}  // namespace cambium
