// SPDX-License-Identifier: BSD-3-Clause
// A mission folder, or a bare .g2o file, as docs/formats.md describes them.
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cambium/dialect.hpp"
#include "cambium/plugin.hpp"
#include "file_payload.hpp"
#include "gnss_file.hpp"
#include "nmea_file.hpp"
#include "payload_check.hpp"
#include "payload_files.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

constexpr const char* image_folder = "individual_images";
constexpr const char* graph_names[] = {"slam_pose_graph.g2o", "slam_pose_graph.slam"};

class MissionFolder final : public MissionReader {
 public:
  void params(ParamVisitor& v) override {
    v("cloud_folders", cloud_folders_,
      "Sub-folders that may hold the clouds; the first that exists");
    v("tree_folder", tree_folder_, "Sub-folder with one tree table a node");
    v("apply_viewpoint", apply_viewpoint_, "Move the points of a cloud by its file's VIEWPOINT");
    v("check_payloads", check_payloads_, "Open every payload once and warn of what is wrong");
  }

  bool accepts(const fs::path& path) const override {
    if (is_graph(path)) return true;
    for (const char* name : graph_names)
      if (fs::exists(path / name)) return true;
    return false;
  }

  Mission read(const fs::path& path, const Context& context) const override {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error || !fs::exists(status))
      throw Error(ErrorCode::data, path.string(),
                  error && fs::exists(status) ? "cannot be opened: " + error.message()
                                              : "does not exist, expected a mission folder or a "
                                                "pose graph (.g2o)");
    if (fs::is_directory(status)) return read_folder(path, context);
    if (!is_graph(path))
      throw Error(ErrorCode::data, path.string(),
                  "is a file, expected a mission folder or a pose graph (.g2o or .slam)");
    return read_g2o(path);
  }

 private:
  Mission read_folder(const fs::path& folder, const Context& context) const {
    Mission mission = read_g2o(graph_in(folder));
    context.check_cancelled();
    mission.folder = folder;
    mission.name = name_of(folder);
    attach_payloads(mission, context);
    read_fixes(mission);
    mission.digest = mission_digest(mission);
    return mission;
  }

  static void read_fixes(Mission& mission) {
    const fs::path table = mission.folder / "gnss.csv", log = mission.folder / "gnss.nmea";
    if (fs::exists(table))
      mission.fixes = load_fixes(table, mission.warnings);
    else if (fs::exists(log))
      mission.fixes = load_nmea(log, mission.warnings);
    if (fs::exists(table) && fs::exists(log))
      mission.warnings.push_back(log.string() + ": not read, because gnss.csv is there");
  }

  static bool is_graph(const fs::path& path) {
    return path.extension() == ".g2o" || path.extension() == ".slam";
  }

  static fs::path graph_in(const fs::path& folder) {
    for (const char* name : graph_names)
      if (fs::exists(folder / name)) return folder / name;
    throw Error(
        ErrorCode::data, folder.string(),
        "holds no slam_pose_graph.g2o and no slam_pose_graph.slam; is it a mission folder?");
  }

  static std::string name_of(const fs::path& folder) {
    const fs::path full = fs::absolute(folder).lexically_normal();
    return (full.has_filename() ? full : full.parent_path()).filename().string();
  }

  void attach_payloads(Mission& mission, const Context& context) const {
    const StampedFiles clouds = clouds_of(mission);
    StampedFiles trees;
    if (fs::exists(mission.folder / tree_folder_))
      trees =
          find_stamped_files(mission.folder / tree_folder_, "trees", {".csv"}, mission.warnings);
    StampedFiles images;  // not every node has one
    if (fs::exists(mission.folder / image_folder))
      images = find_stamped_files(mission.folder / image_folder, "image",
                                  {".jpg", ".jpeg", ".png", ".webp"}, mission.warnings);
    if (!clouds.folder.empty()) report_mismatch(mission, clouds, "cloud", mission.warnings);
    if (!trees.folder.empty()) report_mismatch(mission, trees, "tree table", mission.warnings);
    const std::set<Stamp> shared = shared_stamps(mission, mission.warnings);
    std::vector<PayloadPaths> paths;
    for (Node& node : mission.nodes) {
      if (!node.stamp || shared.contains(*node.stamp)) continue;
      const PayloadPaths p{file_at(clouds, *node.stamp), file_at(trees, *node.stamp),
                           file_at(images, *node.stamp)};
      if (p.cloud.empty() && p.trees.empty() && p.image.empty()) continue;
      node.payload = std::make_shared<FilePayload>(p, apply_viewpoint_);
      paths.push_back(p);
    }
    if (check_payloads_) check_payloads(paths, apply_viewpoint_, context, mission.warnings);
  }

  StampedFiles clouds_of(Mission& mission) const {
    for (const std::string& name : cloud_folders_)
      if (fs::exists(mission.folder / name))
        return find_stamped_files(mission.folder / name, "cloud", {".pcd", ".ply", ".las", ".laz"},
                                  mission.warnings);
    return {};
  }

  static fs::path file_at(const StampedFiles& files, const Stamp& stamp) {
    const auto it = files.by_stamp.find(stamp);
    return it == files.by_stamp.end() ? fs::path{} : it->second;
  }

  std::vector<std::string> cloud_folders_{"individual_clouds", "slam_clouds", "payload_clouds",
                                          "undist-clouds"};
  std::string tree_folder_ = "individual_trees";
  bool apply_viewpoint_ = false;
  bool check_payloads_ = false;
};

}  // namespace
}  // namespace cambium

CAMBIUM_PLUGIN("mission-folder", "0.1.0") {
  registry.add<cambium::MissionFolder>(
      "mission_folder", "Mission folders (pose graph, clouds, trees, GNSS) and bare .g2o files");
}
