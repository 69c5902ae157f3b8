// SPDX-License-Identifier: BSD-3-Clause
// Thins a cloud: one point per voxel, the mean of the points in it.
#include "cambium/plugin.hpp"
#include "common/voxels.hpp"

namespace {

using namespace cambium;

class VoxelGrid final : public PayloadFilter {
 public:
  void params(ParamVisitor& v) override {
    v("size", size_, "Edge of a voxel", above(0.0, "m"));
    v("min_points", min_points_, "Voxels with fewer points are dropped as noise",
      between(1, 1000000));
  }

  Payload apply(const MissionView& mission, std::size_t node,
                const Context& context) const override {
    Payload payload = mission.payload(node);
    if (!payload.cloud) return payload;
    filter::VoxelMeans voxels(size_);
    const std::size_t dropped = voxels.add(*payload.cloud);
    if (dropped > 0)
      context.warn(mission.mission().name + " node " +
                   std::to_string(mission.mission().nodes[node].id) + ": voxel_grid dropped " +
                   std::to_string(dropped) + " of " + std::to_string(payload.cloud->size()) +
                   " points that are not finite or a million voxels away");
    payload.cloud = std::make_shared<const Cloud>(voxels.means(min_points_));
    return payload;
  }

 private:
  double size_ = 0.25;
  int min_points_ = 1;
};

}  // namespace

CAMBIUM_PLUGIN("voxel_grid", "0.1.0") {
  registry.add<VoxelGrid>("voxel_grid", "Thins a cloud to the mean of the points in each voxel");
}
