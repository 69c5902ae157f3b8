// SPDX-License-Identifier: BSD-3-Clause
// TUM and KITTI trajectories as missions without payloads.
#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/plugin.hpp"
#include "common/odometry.hpp"
#include "kitti.hpp"

namespace trajectory {

using namespace cambium;

class Trajectory final : public MissionReader {
 public:
  void params(ParamVisitor& v) override {
    v("sigma_position", sigma_position_, "Of a step of the odometry", above(0, "m"));
    v("sigma_rotation", sigma_rotation_, "Of a step of the odometry", above(0, "rad"));
    v("camera_frame", camera_frame_,
      "KITTI poses are those of a camera that looks along z with y down; false: z is up already");
  }

  bool accepts(const std::filesystem::path& path) const override {
    const auto extension = path.extension();
    return (extension == ".tum" || extension == ".kitti") && std::filesystem::is_regular_file(path);
  }

  Mission read(const std::filesystem::path& path, const Context&) const override {
    Mission mission;
    mission.name = path.stem().string();
    mission.folder = path.parent_path();
    mission.graph_file = path;
    if (path.extension() == ".tum")
      for (const StampedPose& row : read_tum(path)) add(row.stamp, row.T_map_node, mission);
    else
      for (const KittiPose& row : read_kitti(path, times_of(path)))
        add(row.stamp, camera_frame_ ? base_from_camera(row.T) : row.T, mission);
    if (mission.nodes.empty())
      throw Error(ErrorCode::data, path.string(),
                  "has no pose; expected rows of stamp x y z qx qy qz qw (.tum) or of 12 numbers "
                  "([R t] row by row)");
    mission.digest = mission_digest(mission);
    return mission;
  }

 private:
  /// 00.txt has its stamps in times.txt, poses.kitti in poses.times.
  static std::filesystem::path times_of(const std::filesystem::path& path) {
    for (auto candidate : {std::filesystem::path(path).replace_extension(".times"),
                           path.parent_path() / "times.txt"})
      if (std::filesystem::is_regular_file(candidate)) return candidate;
    return {};
  }

  void add(const std::optional<Stamp>& stamp, const SE3& T_mission_node, Mission& mission) const {
    Node node;
    node.id = NodeId(mission.nodes.size());
    node.stamp = stamp;
    node.T_mission_node = T_mission_node;
    if (!mission.nodes.empty())
      mission.edges.push_back(
          odometry_edge(mission.nodes.back(), node, sigma_position_, sigma_rotation_));
    mission.nodes.push_back(std::move(node));
  }

  double sigma_position_ = 0.05, sigma_rotation_ = 0.01;
  bool camera_frame_ = true;
};

}  // namespace trajectory

CAMBIUM_PLUGIN("trajectory", "0.1.0") {
  registry.add<trajectory::Trajectory>("trajectory",
                                       "TUM and KITTI trajectories as missions without payloads");
}
