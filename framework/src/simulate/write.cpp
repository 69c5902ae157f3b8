// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/write.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <unordered_set>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"

namespace cambium::simulate {
namespace {

// A simulation is made again when the power fails: no need to wait for the disk at every cloud.
constexpr auto durability = AtomicFile::Durability::rename_only;

void write_text(const fs::path& path, const std::string& text) {
  AtomicFile file(path, durability);
  file.stream() << text;
  file.commit();
}

std::string stamped(const char* prefix, const Stamp& s, const char* extension) {
  return fmt::format("{}_{}_{:09}{}", prefix, s.sec, s.nsec, extension);
}

void write_fixes(const std::vector<GnssFix>& fixes, const fs::path& path) {
  std::string text = "sec,nsec,lat,lon,alt,sd_e,sd_n,sd_u\n";
  for (const GnssFix& f : fixes)
    fmt::format_to(std::back_inserter(text), "{},{},{:.9f},{:.9f},{:.3f},{:.3f},{:.3f},{:.3f}\n",
                   f.stamp.sec, f.stamp.nsec, f.latitude, f.longitude, f.altitude,
                   std::sqrt(f.covariance(0, 0)), std::sqrt(f.covariance(1, 1)),
                   std::sqrt(f.covariance(2, 2)));
  write_text(path, text);
}

}  // namespace

void write_recording(const Recording& recording, const fs::path& folder) {
  fs::create_directories(folder);
  AtomicFile graph(folder / "slam_pose_graph.g2o", durability);
  write_g2o(graph.stream(), recording.mission);
  graph.commit();
  std::vector<StampedPose> truth;
  for (std::size_t i = 0; i < recording.truth.size(); ++i)
    truth.push_back({*recording.mission.nodes[i].stamp, recording.truth[i].T_world_base});
  write_text(folder / "ground_truth.tum", format_tum(truth));
  if (!recording.mission.fixes.empty()) write_fixes(recording.mission.fixes, folder / "gnss.csv");
}

void write_cloud(const Cloud& cloud, const Stamp& stamp, const fs::path& mission_folder) {
  const fs::path folder = mission_folder / "individual_clouds";
  fs::create_directories(folder);
  AtomicFile file(folder / stamped("cloud", stamp, ".pcd"), durability);
  file.stream() << fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\n"
      "TYPE F F F\nCOUNT 1 1 1\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\n"
      "DATA binary\n",
      cloud.size());
  file.stream().write(reinterpret_cast<const char*>(cloud.xyz.data()),
                      std::streamsize(cloud.xyz.size() * sizeof(float)));
  file.commit();
}

void write_trees(const std::vector<Tree>& trees, const Stamp& stamp,
                 const fs::path& mission_folder) {
  const fs::path folder = mission_folder / "individual_trees";
  fs::create_directories(folder);
  std::string text = "x,y,z,axis_x,axis_y,axis_z,dbh,score,reconstructed\n";
  for (const Tree& t : trees)
    fmt::format_to(std::back_inserter(text),
                   "{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.3f},{:.2f},{}\n", t.base.x(),
                   t.base.y(), t.base.z(), t.axis.x(), t.axis.y(), t.axis.z(), t.dbh, t.score,
                   int(t.reconstructed));
  write_text(folder / stamped("trees", stamp, ".csv"), text);
}

void write_stems(const std::vector<Stem>& stems, const std::vector<Recording>& recordings,
                 const fs::path& path) {
  std::string text = "x,y,z,axis_x,axis_y,axis_z,dbh,height";
  std::vector<std::unordered_set<std::uint64_t>> standing;
  for (const Recording& r : recordings) {
    text += "," + r.mission.name;
    standing.emplace_back();
    for (const Stem& s : r.stems) standing.back().insert(s.mark);
  }
  text += '\n';
  for (const Stem& s : stems) {
    fmt::format_to(std::back_inserter(text),
                   "{:.3f},{:.3f},{:.3f},{:.5f},{:.5f},{:.5f},{:.4f},{:.2f}", s.base.x(),
                   s.base.y(), s.base.z(), s.axis.x(), s.axis.y(), s.axis.z(), s.dbh, s.height);
    for (const auto& marks : standing) text += marks.contains(s.mark) ? ",1" : ",0";
    text += '\n';
  }
  write_text(path, text);
}

void write_loops(const std::vector<LoopPair>& loops, const std::vector<Recording>& recordings,
                 const fs::path& path) {
  std::string text = "tail_mission,tail,head_mission,head,baseline,overlap\n";
  for (const LoopPair& p : loops)
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{:.3f},{:.3f}\n",
                   recordings[p.tail_mission].mission.name,
                   recordings[p.tail_mission].mission.nodes[p.tail].id,
                   recordings[p.head_mission].mission.name,
                   recordings[p.head_mission].mission.nodes[p.head].id, p.baseline, p.overlap);
  write_text(path, text);
}

}  // namespace cambium::simulate
