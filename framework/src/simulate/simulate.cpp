// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate.hpp"

#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "simulate/camera.hpp"
#include "simulate/sensor.hpp"
#include "simulate/tree_table.hpp"
#include "engine/mission_files.hpp"
#include "simulate/write.hpp"

namespace cambium::simulate {
namespace {

struct World {
  Terrain terrain;
  std::vector<Stem> stems, clutter;
};

World make_world(const SimulationSpec& spec) {
  const auto seed = std::uint64_t(spec.seed);
  World w;
  w.terrain = make_terrain(spec.terrain, spec.stand.size, seed);
  w.stems = plant(spec.stand, w.terrain, seed);
  w.clutter = scatter_clutter(spec.clutter, spec.stand, w.terrain, seed);
  return w;
}

// A folder of the same specification is filled again with the same files.
void check_folder(const fs::path& out, const std::string& text) {
  if (!fs::exists(out) || fs::is_empty(out)) return;
  if (fs::exists(out / "spec.yaml") && read_file(out / "spec.yaml") == text) return;
  throw Error(ErrorCode::config, out.string(),
              "holds something that is not a simulation of this specification; choose an empty or "
              "new folder");
}

/// Of what stands, all that a detector may see from somewhere on the path.
std::vector<Stem> in_sight(const std::vector<Stem>& stems, const Recording& r) {
  // The detector measures ranges in the robot's own axes, which lean by a few degrees.
  const double reach = 1.2 * r.spec.trees.max_range + 20;
  Vec3 low = r.truth.front().T_world_base.t, high = low;
  for (const TruePose& p : r.truth) {
    low = low.cwiseMin(p.T_world_base.t);
    high = high.cwiseMax(p.T_world_base.t);
  }
  std::vector<Stem> out;
  for (const Stem& s : stems)
    if (s.base.x() > low.x() - reach && s.base.x() < high.x() + reach &&
        s.base.y() > low.y() - reach && s.base.y() < high.y() + reach)
      out.push_back(s);
  return out;
}

/// Simulates and writes the payloads of one mission, node by node, side by side.
class PayloadWriter {
 public:
  PayloadWriter(const SimulationSpec& spec, const World& world, const Recording& recording)
      : world_(world),
        r_(recording),
        stems_(in_sight(recording.stems, recording)),
        clutter_(in_sight(world.clutter, recording)),
        lidar_(recording.spec.sensor),
        camera_(recording.spec.camera) {
    // Leaves are grown for rays only: over a large stand they are most of the work.
    if (recording.spec.sensor.clouds || recording.spec.camera.enabled)
      scene_.emplace(
          world.terrain, recording.stems, world.clutter,
          grow(spec.foliage, spec.stand, world.terrain, recording.stems, std::uint64_t(spec.seed)));
  }

  std::vector<Footprint> write(const fs::path& folder, const Context& context,
                               MissionSummary& summary) const {
    const std::size_t nodes = r_.truth.size();
    std::vector<Footprint> footprints(nodes);
    std::vector<std::size_t> points(nodes), detections(nodes);
    context.parallel_for(nodes, [&](std::size_t i) {
      context.check_cancelled();
      if (r_.spec.trees.enabled) detections[i] = write_table(i, folder, footprints[i]);
      if (r_.spec.camera.enabled) write_image(i, folder);
      if (r_.spec.sensor.clouds) points[i] = write_scan(i, folder, footprints[i]);
    });
    for (const std::size_t n : points) summary.points += n;
    for (const std::size_t n : detections) summary.detections += n;
    return footprints;
  }

 private:
  // Of two nodes with one stamp the later one's file replaces the other's.
  bool overwritten(std::size_t i) const {
    const auto& nodes = r_.mission.nodes;
    return i + 1 < nodes.size() && nodes[i + 1].stamp == nodes[i].stamp;
  }

  std::size_t write_scan(std::size_t i, const fs::path& folder, Footprint& out) const {
    const SE3& T_world_base = r_.truth[i].T_world_base;
    const Cloud cloud = lidar_.scan(*scene_, T_world_base, Random(r_.seed, "scan", i));
    if (!overwritten(i)) write_cloud(cloud, *r_.mission.nodes[i].stamp, folder);
    out = footprint(cloud, T_world_base);
    return cloud.size();
  }

  void write_image(std::size_t i, const fs::path& folder) const {
    if (!overwritten(i))
      write_picture(camera_.look(*scene_, r_.truth[i].T_world_base, Random(r_.seed, "camera", i)),
                    *r_.mission.nodes[i].stamp, folder);
  }

  std::size_t write_table(std::size_t i, const fs::path& folder, Footprint& out) const {
    TreeTable table = detect(r_.spec.trees, r_.truth[i].T_world_base, stems_, clutter_,
                             world_.terrain, Random(r_.seed, "trees", i));
    if (!overwritten(i)) write_trees(table.trees, *r_.mission.nodes[i].stamp, folder);
    out = std::move(table.stems);
    return table.trees.size();
  }

  const World& world_;
  const Recording& r_;
  std::vector<Stem> stems_, clutter_;  ///< in sight of the path
  Lidar lidar_;
  Camera camera_;
  std::optional<Scene> scene_;
};

MissionSummary summary_of(const Recording& r) {
  MissionSummary s;
  s.name = r.mission.name;
  s.nodes = r.truth.size();
  s.fixes = r.mission.fixes.size();
  for (std::size_t i = 1; i < r.truth.size(); ++i)
    s.length += (r.truth[i].T_world_base.t - r.truth[i - 1].T_world_base.t).norm();
  // Seen from the start: T_first_last as it was and as it is believed to be.
  const SE3 was = r.truth.front().T_world_base.inverse() * r.truth.back().T_world_base;
  const SE3 believed =
      r.mission.nodes.front().T_mission_node.inverse() * r.mission.nodes.back().T_mission_node;
  s.end_error = (was.t - believed.t).norm();
  return s;
}

}  // namespace

Summary simulate(const SimulationSpec& spec, const std::string& text, const fs::path& out,
                 const Context& context) {
  check_folder(out, text);
  const World world = make_world(spec);
  std::vector<Recording> recordings;
  for (std::size_t m = 0; m < spec.missions.size(); ++m)
    recordings.push_back(record(spec, m, world.terrain, world.stems, world.clutter));
  fs::create_directories(out);
  write_file(out / "spec.yaml", text);
  Summary summary;
  summary.stems = world.stems.size();
  std::vector<std::vector<Footprint>> footprints;
  for (const Recording& r : recordings) {
    const fs::path folder = out / r.mission.name;
    summary.missions.push_back(summary_of(r));
    write_recording(r, folder);
    footprints.push_back(
        PayloadWriter(spec, world, r).write(folder, context, summary.missions.back()));
  }
  const auto loops = true_loops(recordings, footprints, spec.loops);
  for (const LoopPair& p : loops) summary.loops_between += p.tail_mission != p.head_mission;
  summary.loops = loops.size();
  write_loops(loops, recordings, out / "loops.csv");
  write_stems(world.stems, recordings, out / "stems.csv");
  return summary;
}

}  // namespace cambium::simulate
