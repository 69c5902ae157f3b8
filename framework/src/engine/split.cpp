// SPDX-License-Identifier: BSD-3-Clause
#include "engine/split.hpp"

#include "cambium/dialect.hpp"
#include "cambium/fused.hpp"

namespace cambium {
namespace {

/// A prior in another frame: its translation is measured along the axes of the frame.
Edge moved(Edge edge, const SE3& T_new_old) {
  edge.T_tail_head = T_new_old * edge.T_tail_head;
  const Mat3 R = T_new_old.rotation();
  Mat6 turn = Mat6::Identity();
  turn.topLeftCorner<3, 3>() = R;
  edge.information = turn * edge.information * turn.transpose();
  if (edge.tag == "EDGE_SE3_PRIOR") {  // it is that of the base already; see PARAMS_SE3OFFSET
    edge.tag.clear();
    edge.extra.clear();
  }
  return edge;
}

}  // namespace

Mission updated_mission(const Atlas& atlas, std::uint32_t m) {
  const MissionState& state = atlas.missions[m];
  Mission out = *state.mission;
  const SE3 T_map_own = T_map_mission(state);
  for (std::size_t i = 0; i < out.nodes.size(); ++i)
    out.nodes[i].T_mission_node = (*state.T_map_node)[i];
  for (Edge& edge : out.edges)
    if (edge.kind == EdgeKind::prior || edge.kind == EdgeKind::position)
      edge = moved(std::move(edge), T_map_own);
  out.georeference = georeference(atlas, atlas.islands[state.island]);
  out.digest = mission_digest(out);
  return out;
}

}  // namespace cambium
