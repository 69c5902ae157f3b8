// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/fused.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "model/own_frame.hpp"

namespace cambium {
namespace {

/// The lines that the dialect has for what `part` holds.
std::vector<std::string> lines_of(const Mission& part) {
  std::stringstream text;
  write_g2o(text, part);
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// Builds the joint graph, one mission after another.
class Fusion {
 public:
  Fusion(const Atlas& atlas, const Island& island) : atlas_(atlas), island_(island) {}

  void add_mission(const MissionState& state) {
    const Mission& mission = *state.mission;
    // FIX lines of the first mission hold the map; priors hold in the frame they were made in.
    const bool anchors = fused_.nodes.empty();
    const bool own_frame = gives_map_frame(state, island_, atlas_);
    comment(fmt::format("MISSION {} PLATFORM_ID {} ID_OFFSET {} NODES {}", mission.name,
                        mission.platform_id, state.id_offset, mission.nodes.size()));
    Mission remarks;
    remarks.unknown_lines = mission.unknown_lines;
    remarks.georeference = mission.georeference;
    add_nodes(state, anchors, remarks);
    for (Edge edge : mission.edges) {
      edge.tail += state.id_offset;
      edge.head += state.id_offset;
      // Its PARAMS_SE3OFFSET line becomes a comment; the model's pose is that of the base already.
      if (edge.tag == "EDGE_SE3_PRIOR") edge.tag.clear();
      const bool unary = edge.kind == EdgeKind::prior || edge.kind == EdgeKind::position;
      (unary && !own_frame ? remarks : fused_).edges.push_back(std::move(edge));
    }
    for (const std::string& line : lines_of(remarks)) {
      const std::size_t text = line.find_first_not_of("# ");
      if (text != std::string::npos) comment(mission.name + ": " + line.substr(text));
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

  void add_position(const NodePosition& position) {
    Edge edge;
    edge.kind = EdgeKind::position;
    edge.tail = edge.head = id(position.node);
    edge.T_tail_head.t = position.t_map;
    edge.information.topLeftCorner<3, 3>() = position.information;
    edge.tag = "EDGE_SE3_PRIORXYZ";
    fused_.edges.push_back(std::move(edge));
  }

  Mission finish() && {
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
    fused_.georeference = georeference(atlas_, island_);
    const auto platform = [&](std::uint32_t m) { return atlas_.missions[m].mission->platform_id; };
    const int first = platform(island_.missions.front());
    if (std::all_of(island_.missions.begin(), island_.missions.end(),
                    [&](std::uint32_t m) { return platform(m) == first; }))
      fused_.platform_id = first;
    return std::move(fused_);
  }

 private:
  void comment(std::string text) { fused_.unknown_lines.push_back({0, "# " + std::move(text)}); }

  NodeId id(NodeRef n) const { return atlas_.node(n).id + atlas_.missions[n.mission].id_offset; }

  void add_nodes(const MissionState& state, bool anchors, Mission& remarks) {
    for (std::size_t i = 0; i < state.mission->nodes.size(); ++i) {
      Node node = state.mission->nodes[i];
      node.id += state.id_offset;
      node.T_mission_node = (*state.T_map_node)[i];
      if (node.fixed && !anchors) {
        remarks.unknown_lines.push_back({0, fmt::format("FIX {}", node.id)});
        node.fixed = false;
      }
      fused_.nodes.push_back(std::move(node));
    }
  }

  const Atlas& atlas_;
  const Island& island_;
  Mission fused_;
};

}  // namespace

Mission fused_mission(const Atlas& atlas, const Island& island) {
  Fusion fusion(atlas, island);
  for (const std::uint32_t m : island.missions) fusion.add_mission(atlas.missions[m]);
  const auto in_island = [&](NodeRef n) {
    return std::binary_search(island.missions.begin(), island.missions.end(), n.mission);
  };
  for (const NodePosition& position : island.positions) fusion.add_position(position);
  for (const Loop& loop : atlas.loops) {
    if (loop.state == LoopState::accepted && in_island(loop.tail) && in_island(loop.head))
      fusion.add_loop(loop);
  }
  return std::move(fusion).finish();
}

}  // namespace cambium
