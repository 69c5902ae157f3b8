// SPDX-License-Identifier: BSD-3-Clause
// Ground against canopy on a real plot: the walked cloud of aerial_terrestrial_ftvalley, turned by
// 15 degrees and moved by 10 m, tied to those of the drone and of the aircraft.
//   bench_canopy [FORT_VALLEY [SETTINGS]]     the unpacked archive; parameters of canopy_match
// All clouds are in one frame, so the motion is known. Prints the table of docs/canopy.md.
#include <cstdio>
#include <numbers>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;

const SE3 T_world_plot = SE3::from_yaw(0, {41, 35, 10});  // the middle of the plot
const SE3 T_moved_plot = SE3::from_yaw(15 * std::numbers::pi / 180, {8, -6, 1.5});

/// A mission folder of one node with this cloud, read by the real reader.
Mission single_cloud(const fs::path& pcd, const std::string& name, const fs::path& folder) {
  fs::create_directories(folder / name / "individual_clouds");
  fs::copy_file(pcd, folder / name / "individual_clouds/cloud_1000_000000000.pcd");
  write_file(folder / name / "slam_pose_graph.g2o",
             "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 1000 0\n");
  return component<MissionReader>("mission_folder", "{}")->read(folder / name, *make_context());
}

/// The same with the cloud moved: p_node = T * p_file.
Mission moved_by(Mission mission, const SE3& T) {
  mission.nodes[0].payload = in_memory(transformed(T, *mission.nodes[0].payload->load().cloud));
  return mission;
}

Mission filtered(Mission mission, const std::string& filter, const std::string& yaml) {
  const Atlas atlas = make_atlas({mission});
  mission.nodes[0].payload =
      in_memory(component<PayloadFilter>(filter, yaml)->apply({atlas, 0}, 0, *make_context()));
  return mission;
}

std::size_t trees(const Mission& mission) { return mission.nodes[0].payload->load().trees->size(); }

void row(const char* name, const Mission& ground, const Mission& above,
         const std::string& settings) {
  const auto context = make_context();
  const auto recognizer = component<PlaceRecognizer>("canopy_match", settings);
  const Atlas atlas = make_atlas({above, ground});
  const std::uint32_t a = atlas.missions[0].mission->name == above.name ? 0 : 1;
  const auto found = recognizer->match(recognizer->describe({atlas, 1 - a}, *context),
                                       recognizer->describe({atlas, a}, *context), {}, *context);
  std::printf("| %s | %zu | %zu | ", name, trees(ground), trees(above));
  if (found.empty()) return void(std::puts("not tied | | |"));
  const auto registration = component<Registration>(
      "tree_align",
      "{coarse_radius: 2.0, radius: 1.2, sigma_stem: 0.6, sigma_base: 0.3, max_rmse: 1.0, "
      "max_height_change: 2.0, min_height_share: 0.3}");
  const Alignment fit = registration->align({above.nodes[0].payload->load(), {}, 0},
                                            {ground.nodes[0].payload->load(), {}, 0},
                                            *found[0].T_reference_query, *context);
  const SE3 truth = T_moved_plot.inverse();
  const auto off = [&](const SE3& T) {
    const Vec3 d = T * (T_moved_plot * Vec3(Vec3::Zero()));  // the middle of the plot
    std::printf("%.2f m, %.2f m up, %.2f deg | ", d.head<2>().norm(), d.z(),
                rotation_angle(truth.inverse() * T) * 180 / std::numbers::pi);
  };
  off(*found[0].T_reference_query);
  if (fit.converged) off(fit.T_target_source);
  std::printf("%.1f |\n", found[0].score);
}

int run(int argc, char** argv) {
  const std::string settings = argc > 2 ? argv[2] : "{}";
  const fs::path data = argc > 1 ? fs::path(argv[1]) : real_data("aerial_terrestrial_ftvalley");
  if (data.empty()) return std::puts("aerial_terrestrial_ftvalley is not there: skipped"), 0;
  fs::path folder = data;
  if (!fs::exists(folder / "MLS_Clip.pcd")) folder /= "forest_ftvalley_multisensor";
  const TemporaryFolder scratch;
  const SE3 T_plot_world = T_world_plot.inverse();
  const auto read = [&](const char* name, const SE3& T) {
    return moved_by(single_cloud(folder / (std::string(name) + "_Clip.pcd"), name, scratch.path()),
                    T);
  };
  const Mission walked = read("MLS", T_moved_plot * T_plot_world);
  const Mission stems = filtered(walked, "stem_extraction", "{}"),
                tops = filtered(walked, "tree_tops", "{}");
  std::puts(
      "| ground against air | trees of the ground | tops | canopy_match is off by | tree_align is "
      "off by | score |\n"
      "|---|---:|---:|---|---|---:|");
  for (const char* name : {"UAS", "ALS"}) {
    const Mission above = filtered(read(name, T_plot_world), "tree_tops", "{}");
    row((std::string("stems, ") + name).c_str(), stems, above, settings);
    row((std::string("tops of the walked cloud, ") + name).c_str(), tops, above, settings);
  }
  return 0;
}

}  // namespace
}  // namespace cambium::testing

int main(int argc, char** argv) { return cambium::testing::run(argc, argv); }
