// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

Digest digest_of(const Mission& mission) {
  Hasher hasher;
  hasher.add(mission.name);
  for (const Node& node : mission.nodes) {
    for (int k = 0; k < 3; ++k) hasher.add(node.T_mission_node.t[k]);
    for (int k = 0; k < 4; ++k) hasher.add(node.T_mission_node.q.coeffs()[k]);
  }
  return hasher.digest();
}

Mat6 odometry_information() {
  Mat6 information = Mat6::Identity() / (0.05 * 0.05);
  information.bottomRightCorner<3, 3>() = Mat3::Identity() / (0.01 * 0.01);
  return information;
}

std::vector<SE3> poses_of(const Mission& mission) {
  std::vector<SE3> out;
  for (const Node& node : mission.nodes) out.push_back(node.T_mission_node);
  return out;
}

}  // namespace

Mission make_mission(const std::string& name, const std::vector<SE3>& poses) {
  Mission mission;
  mission.name = name;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    Node node;
    node.id = NodeId(i);
    node.stamp = Stamp{std::int64_t(i), 0};
    node.T_mission_node = poses[i];
    mission.nodes.push_back(node);
    if (i == 0) continue;
    Edge edge;
    edge.tail = NodeId(i - 1);
    edge.head = NodeId(i);
    edge.T_tail_head = poses[i - 1].inverse() * poses[i];
    edge.information = odometry_information();
    edge.tag = "EDGE_SE3:QUAT";
    mission.edges.push_back(edge);
  }
  mission.digest = digest_of(mission);
  return mission;
}

Atlas make_atlas(std::vector<Mission> missions) {
  std::sort(missions.begin(), missions.end(),
            [](const Mission& a, const Mission& b) { return a.name < b.name; });
  Atlas atlas;
  PayloadSources payloads;
  NodeId offset = 0;
  for (std::uint32_t m = 0; m < missions.size(); ++m) {
    MissionState state;
    state.T_map_node = std::make_shared<const std::vector<SE3>>(poses_of(missions[m]));
    state.island = m;
    state.id_offset = offset;
    offset += 10000;
    payloads.emplace_back();
    for (const Node& node : missions[m].nodes) payloads.back().push_back(node.payload);
    state.mission = std::make_shared<const Mission>(std::move(missions[m]));
    atlas.missions.push_back(std::move(state));
    atlas.islands.push_back({{m}, std::nullopt});
  }
  atlas.payloads = std::make_shared<const PayloadSources>(std::move(payloads));
  return atlas;
}

}  // namespace cambium::testing
