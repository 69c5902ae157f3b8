// SPDX-License-Identifier: BSD-3-Clause
#include "bench/registration_data.hpp"

#include <fstream>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::bench {
namespace {

namespace fs = std::filesystem;
using testing::component;

std::vector<Scan> scans_of(const fs::path& folder) {
  const auto reader = component<MissionReader>("mission_folder");
  const Mission mission = reader->read(folder, *testing::make_context());
  std::vector<Scan> scans;
  for (const Node& node : mission.nodes)
    if (node.payload) scans.push_back({node.payload->load(), node.T_mission_node});
  return scans;
}

// Row by row the upper 3 x 4 of T_world_base (the KITTI format).
std::vector<SE3> read_kitti(const fs::path& path, std::size_t count) {
  std::ifstream in(path);
  std::vector<SE3> poses;
  while (poses.size() < count) {
    Mat4 T = Mat4::Identity();
    for (int i = 0; i < 12; ++i) in >> T(i / 4, i % 4);
    if (!in) throw Error(ErrorCode::data, path.string(), "too few poses");
    poses.push_back(SE3::from_matrix(T));
  }
  return poses;
}

// The recorder left a block of old bytes behind the points, which a mission's reader rightly
// refuses.
void copy_promised(const fs::path& from, const fs::path& to) {
  std::ifstream in(from, std::ios::binary);
  std::ofstream out(to, std::ios::binary);
  std::size_t points = 0, bytes = 0;
  for (std::string line; bytes == 0 && std::getline(in, line);) {
    out << line << '\n';
    if (line.starts_with("POINTS ")) points = std::stoul(line.substr(7));
    if (line == "DATA binary") bytes = points * 4 * sizeof(float);  // x y z intensity
  }
  std::string body(bytes, '\0');
  if (!in.read(body.data(), std::streamsize(bytes)))
    throw Error(ErrorCode::data, from.string(), "too few points");
  out << body;
}

}  // namespace

std::vector<Scan> newer_college(const std::string& mission) {
  const fs::path data = testing::real_data("missions_newer_college");
  if (data.empty()) return {};
  std::vector<Scan> scans = scans_of(data / mission);
  const std::vector<StampedPose> truth = read_tum(data / mission / "ground_truth.tum");
  if (truth.size() != scans.size())
    throw Error(ErrorCode::data, (data / mission).string(),
                "scans and true poses differ in number");
  for (std::size_t i = 0; i < scans.size(); ++i) scans[i].T_world_base = truth[i].T_map_node;
  return scans;
}

std::vector<Scan> nclt() {
  const fs::path data = testing::real_data("missions_nclt");
  return data.empty() ? std::vector<Scan>{} : scans_of(data / "mission_nclt");
}

std::vector<Scan> mulran(const std::string& sequence) {
  constexpr std::size_t count = 21;
  const fs::path data = testing::real_data("scans_mulran");
  if (data.empty()) return {};
  // The scans have no mission folder: one is made around them, so that the reader is the usual one.
  const testing::TemporaryFolder folder;
  fs::create_directory(folder / "individual_clouds");
  const Mission mission =
      testing::make_mission(sequence, read_kitti(data / sequence / "optimized_poses.txt", count));
  for (std::size_t i = 0; i < count; ++i) {
    char scan[32], cloud[64];
    std::snprintf(scan, sizeof scan, "%06zu.pcd", i);
    std::snprintf(cloud, sizeof cloud, "individual_clouds/cloud_%lld_%09d.pcd",
                  static_cast<long long>(mission.nodes[i].stamp->sec),
                  mission.nodes[i].stamp->nsec);
    copy_promised(data / sequence / "Scans" / scan, folder / cloud);
  }
  std::ofstream graph(folder / "slam_pose_graph.g2o");
  write_g2o(graph, mission);
  graph.close();
  return scans_of(folder.path());
}

}  // namespace cambium::bench
