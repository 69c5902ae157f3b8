// SPDX-License-Identifier: BSD-3-Clause
// Recordings in the layout of the EuRoC MAV data sets: poses, pictures and inertial measurements.
#include <algorithm>
#include <cstdlib>

#include "cambium/dialect.hpp"
#include "cambium/plugin.hpp"
#include "common/odometry.hpp"
#include "recording.hpp"

namespace euroc {

using namespace cambium;
namespace fs = std::filesystem;

namespace {

struct Camera {
  std::string name;
  std::map<std::int64_t, fs::path> frames;
};

/// The frame nearest in time, if it is not farther than `limit` [ns].
const fs::path* frame_at(const Camera& camera, std::int64_t time, std::int64_t limit) {
  const auto after = camera.frames.lower_bound(time);
  auto best = camera.frames.end();
  for (auto it : {after, after == camera.frames.begin() ? after : std::prev(after)})
    if (it != camera.frames.end() &&
        (best == camera.frames.end() || std::abs(it->first - time) < std::abs(best->first - time)))
      best = it;
  if (best == camera.frames.end() || std::abs(best->first - time) > limit) return nullptr;
  return &best->second;
}

}  // namespace

class Euroc final : public MissionReader {
 public:
  void params(ParamVisitor& v) override {
    v("poses", poses_, "Sub-folders of mav0 that may hold the poses; the first that exists");
    v("spacing", spacing_, "A pose becomes a node after so much way; 0: every pose",
      at_least(0, "m"));
    v("max_time_difference", max_time_difference_,
      "A picture belongs to a node when it is not farther from it in time", at_least(0, "s"));
    v("sigma_position", sigma_position_, "Of a step of the odometry", above(0, "m"));
    v("sigma_rotation", sigma_rotation_, "Of a step of the odometry", above(0, "rad"));
  }

  bool accepts(const fs::path& path) const override { return !table_in(root_of(path)).empty(); }

  Mission read(const fs::path& path, const Context& context) const override {
    const fs::path root = root_of(path), table = table_in(root);
    if (table.empty())
      throw Error(
          ErrorCode::data, path.string(),
          "is no recording in EuRoC's layout: expected mav0/" + poses_.front() + "/data.csv");
    Mission mission;
    mission.folder = path;
    mission.graph_file = table;
    mission.name = name_of(path);
    add_nodes(read_poses(table), mission);
    context.check_cancelled();
    add_payloads(root, mission);
    mission.digest = mission_digest(mission);
    return mission;
  }

 private:
  static fs::path root_of(const fs::path& path) {
    return fs::is_directory(path / "mav0") ? path / "mav0" : path;
  }

  fs::path table_in(const fs::path& root) const {
    for (const std::string& name : poses_)
      if (fs::is_regular_file(root / name / "data.csv")) return root / name / "data.csv";
    return {};
  }

  static std::string name_of(const fs::path& path) {
    fs::path full = fs::absolute(path).lexically_normal();
    if (!full.has_filename()) full = full.parent_path();
    return (full.filename() == "mav0" ? full.parent_path() : full).filename().string();
  }

  void add_nodes(const std::vector<TimedPose>& poses, Mission& mission) const {
    double way = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      if (i > 0) way += (poses[i].T_mission_body.t - poses[i - 1].T_mission_body.t).norm();
      if (i > 0 && way < spacing_) continue;
      way = 0;
      Node node;
      node.id = NodeId(mission.nodes.size());
      node.stamp = poses[i].stamp;
      node.T_mission_node = poses[i].T_mission_body;
      if (i > 0)
        mission.edges.push_back(
            odometry_edge(mission.nodes.back(), node, sigma_position_, sigma_rotation_));
      mission.nodes.push_back(std::move(node));
    }
  }

  void add_payloads(const fs::path& root, Mission& mission) const {
    const std::vector<Camera> cameras = cameras_in(root, mission.warnings);
    auto imu = std::make_shared<std::vector<ImuSample>>();
    if (fs::is_regular_file(root / "imu0/data.csv")) *imu = read_imu(root / "imu0/data.csv");
    const auto sample_at = [&](std::int64_t time) {
      return std::size_t(
          std::lower_bound(imu->begin(), imu->end(), time,
                           [](const ImuSample& s, std::int64_t t) { return s.stamp < t; }) -
          imu->begin());
    };
    for (std::size_t n = 0; n < mission.nodes.size(); ++n) {
      Node& node = mission.nodes[n];
      const std::int64_t time = nanoseconds(*node.stamp);
      const bool last = n + 1 == mission.nodes.size();
      const std::size_t begin = sample_at(time);
      const std::size_t end =
          last ? imu->size() : sample_at(nanoseconds(*mission.nodes[n + 1].stamp));
      auto images = images_at(cameras, time);
      if (images.empty() && begin == end) continue;
      node.payload =
          std::make_shared<NodePayload>(std::move(images), imu, begin, end, root.string());
    }
  }

  static std::vector<Camera> cameras_in(const fs::path& root, std::vector<std::string>& warnings) {
    std::vector<Camera> out;
    for (int i = 0; fs::is_regular_file(root / ("cam" + std::to_string(i)) / "data.csv"); ++i) {
      const fs::path table = root / ("cam" + std::to_string(i)) / "data.csv";
      std::vector<std::string> missing;
      out.push_back({"cam" + std::to_string(i), read_frames(table, missing)});
      if (!missing.empty())
        warnings.push_back(table.string() + ": " + std::to_string(missing.size()) +
                           " pictures are not in data/: " + missing.front() +
                           (missing.size() > 1 ? " ..." : ""));
    }
    return out;
  }

  std::vector<Image> images_at(const std::vector<Camera>& cameras, std::int64_t time) const {
    std::vector<Image> out;
    for (const Camera& camera : cameras)
      if (const auto* file = frame_at(camera, time, std::int64_t(max_time_difference_ * 1e9)))
        out.push_back({*file, camera.name});
    return out;
  }

  std::vector<std::string> poses_{"state_groundtruth_estimate0", "vicon0"};
  double spacing_ = 0.5, max_time_difference_ = 0.05;
  double sigma_position_ = 0.05, sigma_rotation_ = 0.01;
};

}  // namespace euroc

CAMBIUM_PLUGIN("euroc-reader", "0.1.0") {
  registry.add<euroc::Euroc>("euroc", "EuRoC-style folders: poses, pictures and IMU of mav0/");
}
