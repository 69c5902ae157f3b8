// SPDX-License-Identifier: BSD-3-Clause
// Joins the clouds that the robot took shortly before and after a node, in the node's base frame.
#include "cambium/plugin.hpp"
#include "common/neighbours.hpp"
#include "joined.hpp"

namespace submap {

using namespace cambium;

class Submap final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("radius", radius_, "Of the clouds that are joined, along the path before and after the node",
      between(0.0, 1000.0, "m"));
    v("spacing", spacing_, "Nodes nearer along the path to one that is used are left out",
      between(0.0, 1000.0, "m"));
    v("max_range", max_range_, "Points farther from the node are dropped", above(0.0, "m"));
    v("voxel", voxel_, "Thins to the mean of the points in voxels of this edge; 0 keeps all points",
      between(0.0, 100.0, "m"));
  }

  std::string check_params() const override {
    // The grid has 2^20 voxels to either side.
    return max_range_ < voxel_ * (1 << 20) || voxel_ == 0 ? "" : "voxel is too small for max_range";
  }

  bool uses_neighbours() const override { return true; }

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    const auto& nodes = mission.mission().nodes;
    const SE3 T_node_mission = nodes[node].T_mission_node.inverse();
    Joined joined(voxel_);
    std::size_t not_finite = 0;
    for (const std::size_t i : filter::neighbours(mission.mission(), node, radius_, spacing_)) {
      context.check_cancelled();
      const auto cloud = mission.payload(i).cloud;
      if (!cloud) continue;
      const SE3 T_node_i = i == node ? SE3{} : T_node_mission * nodes[i].T_mission_node;
      joined.add(within_range(transformed(T_node_i, *cloud), not_finite));
    }
    if (not_finite > 0)
      context.warn(mission.mission().name + " node " + std::to_string(nodes[node].id) +
                   ": submap dropped " + std::to_string(not_finite) +
                   " points that are not finite");
    payload.cloud = std::make_shared<const Cloud>(joined.take());
    return payload;
  }

 private:
  Cloud within_range(const Cloud& cloud, std::size_t& not_finite) const {
    std::vector<std::size_t> kept;
    const auto points = cloud.points();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      if (!points.col(i).allFinite())
        ++not_finite;
      else if (points.col(i).norm() <= max_range_)
        kept.push_back(std::size_t(i));
    }
    return select(cloud, kept);
  }

  double radius_ = 15.0;
  double spacing_ = 0.5;
  double max_range_ = 40.0;
  double voxel_ = 0.04;
};

}  // namespace submap

CAMBIUM_PLUGIN("submap", "0.1.0") {
  registry.add<submap::Submap>("submap", "Joins the clouds of neighbouring nodes along the path");
}
