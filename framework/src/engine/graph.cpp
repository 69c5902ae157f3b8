// SPDX-License-Identifier: BSD-3-Clause
#include "engine/graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numbers>

#include "model/own_frame.hpp"

namespace cambium {
namespace {

class Builder {
 public:
  Builder(const Atlas& atlas, const Island& island) : atlas_(atlas), island_(island) {
    for (const std::uint32_t m : island.missions) {
      first_[m] = out.nodes.size();
      const MissionState& state = atlas.missions[m];
      for (std::uint32_t n = 0; n < state.mission->nodes.size(); ++n) {
        out.nodes.push_back({m, n});
        out.graph.T_map_node.push_back((*state.T_map_node)[n]);
        out.graph.ids.push_back(state.mission->nodes[n].id + state.id_offset);
      }
    }
    out.graph.fixed.assign(out.nodes.size(), false);
  }

  void add_edges(std::uint32_t m, const std::function<void(const std::string&)>& warn) {
    const Mission& mission = *atlas_.missions[m].mission;
    const bool own_frame = gives_map_frame(atlas_.missions[m], island_, atlas_);
    std::size_t unused = 0;
    for (const Edge& e : mission.edges) {
      const std::size_t head = index(m, e.head);
      const std::string label = fmt::format("{}:{}", mission.graph_file.string(), e.line);
      if (e.kind == EdgeKind::odometry || e.kind == EdgeKind::loop)
        out.graph.relative.push_back({index(m, e.tail), head, e.T_tail_head, e.information,
                                      e.kind == EdgeKind::loop, label});
      else if (!own_frame)
        ++unused;
      else if (e.kind == EdgeKind::prior)
        out.graph.priors.push_back({head, e.T_tail_head, e.information, label});
      else
        out.graph.positions.push_back(
            {head, e.T_tail_head.t, e.information.topLeftCorner<3, 3>(), true, label});
    }
    if (unused > 0)
      warn(
          fmt::format("{}: {} priors are not used: they hold in the mission's own frame, and the "
                      "frame of its island is {}",
                      mission.graph_file.string(), unused, whose_frame()));
  }

  void add_attitudes(std::uint32_t m, double sigma) {
    const auto& nodes = atlas_.missions[m].mission->nodes;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      out.graph.attitude.push_back(
          {first_[m] + n, nodes[n].T_mission_node.q.conjugate() * Vec3::UnitZ(), sigma});
  }

  void add_positions() {
    for (const NodePosition& p : island_.positions)
      out.graph.positions.push_back({first_.at(p.node.mission) + p.node.node, p.t_map,
                                     p.information, true,
                                     fmt::format("GNSS position of node {}", id(p.node))});
  }

  void add_loops() {
    for (std::size_t i = 0; i < atlas_.loops.size(); ++i) {
      const Loop& loop = atlas_.loops[i];
      if (loop.state != LoopState::accepted || !first_.contains(loop.tail.mission)) continue;
      const std::size_t tail = first_[loop.tail.mission] + loop.tail.node;
      const std::size_t head = first_[loop.head.mission] + loop.head.node;
      out.graph.relative.push_back(
          {tail, head, loop.T_tail_head, loop.information, true,
           fmt::format("loop {}-{}", out.graph.ids[tail], out.graph.ids[head])});
      out.loops.push_back(i);
    }
  }

  void fix_gauge() {
    const std::uint32_t m = island_.missions.front();
    const auto& nodes = atlas_.missions[m].mission->nodes;
    bool any = false;
    for (std::size_t n = 0; n < nodes.size(); ++n)
      if (nodes[n].fixed) any = out.graph.fixed[first_[m] + n] = true;
    if (!any && out.graph.priors.empty() && out.graph.positions.size() < 3)
      out.graph.fixed[first_[m]] = true;
    else if (!any && !island_.positions.empty())
      keep_level(m);
  }

  IslandGraph out;

 private:
  std::string whose_frame() const {
    const MissionState& first = atlas_.missions[island_.missions.front()];
    return gives_map_frame(first, island_, atlas_)
               ? fmt::format("that of '{}'", first.mission->name)
               : "turned to the vertical that most missions share";
  }

  // Positions along a straight path leave the roll about it free.
  void keep_level(std::uint32_t m) {
    const Vec3 up = (*atlas_.missions[m].T_map_node)[0].q.conjugate() * Vec3::UnitZ();
    out.graph.attitude.push_back({first_[m], up, 1.0 * std::numbers::pi / 180});
  }

  NodeId id(NodeRef n) const { return atlas_.node(n).id + atlas_.missions[n.mission].id_offset; }

  std::size_t index(std::uint32_t m, NodeId id) const {
    return first_.at(m) + atlas_.missions[m].mission->index_of(id).value();
  }

  const Atlas& atlas_;
  const Island& island_;
  std::map<std::uint32_t, std::size_t> first_;  // mission -> its first graph node
};

}  // namespace

IslandGraph build_graph(const Atlas& atlas, std::uint32_t island, double attitude_sigma,
                        const std::set<std::uint32_t>& not_level,
                        const std::function<void(const std::string&)>& warn) {
  Builder builder(atlas, atlas.islands[island]);
  for (const std::uint32_t m : atlas.islands[island].missions) {
    builder.add_edges(m, warn);
    if (attitude_sigma > 0 && !not_level.contains(m)) builder.add_attitudes(m, attitude_sigma);
  }
  builder.add_positions();
  builder.add_loops();
  builder.fix_gauge();
  return std::move(builder.out);
}

}  // namespace cambium
