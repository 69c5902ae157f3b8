// SPDX-License-Identifier: BSD-3-Clause
// Reads a TUM trajectory (stamp x y z qx qy qz qw) as a mission without payloads. Replace read() by
// your format; what to keep to: docs/write-a-plugin.md.
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"

using namespace cambium;

class MyMethod final : public MissionReader {
 public:
  void params(ParamVisitor& v) override {
    v("sigma", sigma_, "Standard deviation of a step of the odometry", above(0.0, "m"));
  }
  bool accepts(const std::filesystem::path& path) const override {
    return path.extension() == ".tum" && std::filesystem::is_regular_file(path);
  }

  Mission read(const std::filesystem::path& path, const Context&) const override {
    const std::string text = read_file(path);
    Mission mission;
    mission.name = path.stem().string();
    mission.folder = path.parent_path();
    mission.graph_file = path;
    for (const StampedPose& row : parse_tum(text, path)) {
      Node node;
      node.id = NodeId(mission.nodes.size());
      node.stamp = row.stamp;
      node.T_mission_node = row.T_map_node;
      if (!mission.nodes.empty()) mission.edges.push_back(step(mission.nodes.back(), node));
      mission.nodes.push_back(node);
    }
    if (mission.nodes.empty())
      throw Error(ErrorCode::data, path.string(),
                  "has no pose; expected rows of stamp x y z qx qy qz qw");
    mission.digest = Hasher().add(text).add(sigma_).digest();
    return mission;
  }

 private:
  Edge step(const Node& tail, const Node& head) const {
    Edge edge;
    edge.tail = tail.id;
    edge.head = head.id;
    edge.T_tail_head = tail.T_mission_node.inverse() * head.T_mission_node;
    edge.information = Mat6::Identity() / (sigma_ * sigma_);
    edge.tag = "EDGE_SE3:QUAT";
    return edge;
  }

  double sigma_ = 0.05;
};

CAMBIUM_PLUGIN("my_method", "0.1.0") {
  registry.add<MyMethod>("my_method", "TUM trajectories as missions without payloads");
}
