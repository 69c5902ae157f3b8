// SPDX-License-Identifier: BSD-3-Clause
#include "island_data.hpp"

#include <atomic>
#include <set>

#include "cambium/files.hpp"
#include "common/payloads.hpp"
#include "intensity_range.hpp"
#include "pair_cloud.hpp"

namespace web_view {
namespace {

using namespace cambium;
namespace fs = std::filesystem;

std::set<NodeRef> ends_of_loops(const Atlas& atlas) {
  std::set<NodeRef> out;
  for (const Loop& loop : atlas.loops) out.insert({loop.tail, loop.head});
  return out;
}

fs::path spill_file(const Context& context) {
  static std::atomic<int> count{0};  // exports may run side by side
  fs::create_directories(context.scratch());
  return context.scratch() / ("web_view_" + std::to_string(count++) + ".points");
}

/// What one pass over the payloads finds.
struct Collected {
  Spill spill;
  IntensityRange intensities;
  std::size_t left_out = 0;
  bool with_intensity = false;

  void add(const Cloud& cloud, const SE3& T_map_node, std::uint32_t node) {
    const Eigen::Matrix3d R = T_map_node.rotation();
    const auto points = cloud.points();
    with_intensity = with_intensity || !cloud.intensity.empty();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      auto p = quantised(R * points.col(i).cast<double>() + T_map_node.t);
      if (!p) {
        ++left_out;
        continue;
      }
      p->node = node;
      if (!cloud.label.empty()) p->label = cloud.label[std::size_t(i)];
      if (!cloud.intensity.empty()) {
        p->intensity = cloud.intensity[std::size_t(i)];
        intensities.add(p->intensity);
      }
      spill.add(*p);
    }
  }
};

TileTree write_tiles(const Atlas& atlas, Collected& collected, const std::string& folder,
                     const Settings& settings, const Context& context, Output& output) {
  collected.spill.finish();
  const TileOptions options{std::size_t(settings.tile_points),
                            std::int64_t(settings.voxel_size * units_per_metre + 0.5),
                            first_nodes(atlas)};
  const auto [low, high] = collected.intensities.range();
  context.expect(collected.spill.chunks().size());
  return build_tiles(
      collected.spill, options,
      [&](const Tile& tile) {
        output.write(folder + tile.name + ".bin", tile_bytes(tile, low, high));
      },
      [&] {
        context.check_cancelled();
        context.advance();
      });
}

/// Its name on the page.
std::string copy_image(const fs::path& file, std::uint32_t node, Output& output) {
  const std::string name = "images/" + std::to_string(node) + file.extension().string();
  output.write(name, read_file(file));
  return name;
}

}  // namespace

void Output::write(const std::string& name, const std::string& bytes) {
  const fs::path path = folder / name;
  fs::create_directories(path.parent_path());
  AtomicFile file(path, AtomicFile::Durability::rename_only);  // map.json, the last one, is synced
  file.stream() << bytes;
  file.commit();
  files.push_back(path);
}

Json write_island(const Atlas& atlas, std::size_t index, const Settings& settings,
                  const Context& context, Output& output, Json& stems, Json& images) {
  const Island& island = atlas.islands[index];
  const auto first = first_nodes(atlas);
  const auto ends = ends_of_loops(atlas);
  Collected collected{.spill = Spill(spill_file(context)), .intensities = {}};
  Json pairs = Json::array();
  const auto nodes = map_export::nodes_with_payload(atlas, island.missions);
  map_export::for_each_payload(atlas, nodes, context, [&](NodeRef node, const Payload& payload) {
    const std::uint32_t number = first[node.mission] + node.node;
    if (settings.images && payload.images)
      images.push_back({number, copy_image(payload.images->front().file, number, output)});
    if (!payload.cloud || payload.cloud->empty()) return;
    collected.add(*payload.cloud, atlas.T_map_node(node), number);
    if (settings.pair_points == 0 || !ends.contains(node)) return;
    output.write("pairs/" + std::to_string(number) + ".bin",
                 pair_cloud(*payload.cloud, std::size_t(settings.pair_points)));
    pairs.push_back(number);
  });
  if (collected.left_out > 0)
    context.warn(
        "island " + std::to_string(index) + ": " + std::to_string(collected.left_out) +
        " points are not finite or lie more than 524 km from the origin; they are left out");
  const std::string folder = "tiles/" + std::to_string(index) + "/";
  const TileTree tree = write_tiles(atlas, collected, folder, settings, context, output);
  StemOptions options;
  options.min_sightings = settings.stem_sightings;
  for (Json& stem : stems_json(stems_of(atlas, island.missions, options, context), index))
    stems.push_back(std::move(stem));
  const auto [low, high] = collected.intensities.range();
  return {{"missions", island.missions},
          {"points", tiles_json(tree, folder)},
          {"intensity", collected.with_intensity ? Json{low, high} : Json(nullptr)},
          {"pairs", std::move(pairs)}};
}

}  // namespace web_view
