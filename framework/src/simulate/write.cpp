// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/write.hpp"

#include <fmt/format.h>

#include <iterator>
#include <unordered_map>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "engine/mission_files.hpp"

namespace cambium::simulate {
namespace {

// A simulation is made again when the power fails: no need to wait for the disk at every cloud.
constexpr auto durability = AtomicFile::Durability::rename_only;

void write_text(const fs::path& path, const std::string& text) {
  AtomicFile file(path, durability);
  file.stream() << text;
  file.commit();
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
  if (!recording.mission.fixes.empty()) write_fixes(recording.mission.fixes, folder);
}

void write_picture(const Picture& picture, const Stamp& stamp, const fs::path& mission_folder) {
  const fs::path folder = mission_folder / "individual_images";
  fs::create_directories(folder);
  write_text(folder / stamped("image", stamp, ".png"), png_of(picture));
}

void write_stems(const std::vector<Stem>& stems, const std::vector<Recording>& recordings,
                 const fs::path& path) {
  std::string text = "x,y,z,axis_x,axis_y,axis_z,dbh,height";
  std::vector<std::unordered_map<std::uint64_t, double>> standing;  // diameters by mark
  for (const Recording& r : recordings) {
    text += "," + r.mission.name;
    standing.emplace_back();
    for (const Stem& s : r.stems) standing.back().emplace(s.mark, s.dbh);
  }
  // Only where they are not those of the column dbh.
  for (const Recording& r : recordings)
    if (r.spec.growth > 0) text += ",dbh_" + r.mission.name;
  text += '\n';
  for (const Stem& s : stems) {
    fmt::format_to(std::back_inserter(text),
                   "{:.3f},{:.3f},{:.3f},{:.5f},{:.5f},{:.5f},{:.4f},{:.2f}", s.base.x(),
                   s.base.y(), s.base.z(), s.axis.x(), s.axis.y(), s.axis.z(), s.dbh, s.height);
    for (const auto& marks : standing) text += marks.contains(s.mark) ? ",1" : ",0";
    for (std::size_t m = 0; m < recordings.size(); ++m) {
      if (!(recordings[m].spec.growth > 0)) continue;
      const auto then = standing[m].find(s.mark);
      text += then == standing[m].end() ? "," : fmt::format(",{:.4f}", then->second);
    }
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
