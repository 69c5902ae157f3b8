// SPDX-License-Identifier: BSD-3-Clause
// The clouds of all nodes as LAS 1.4, in any coordinate reference system, tile by tile.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>

#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "common/crs.hpp"
#include "common/voxel_set.hpp"
#include "las_file.hpp"
#include "tiles.hpp"

namespace las {
namespace {

using namespace cambium;

/// Okabe and Ito's colours, told apart by the colour-blind too; 8 bits each.
constexpr std::uint8_t palette[][3] = {{230, 159, 0},  {86, 180, 233}, {0, 158, 115},
                                       {240, 228, 66}, {0, 114, 178},  {213, 94, 0},
                                       {204, 121, 167}};

/// From the map to the coordinates of the file.
struct System {
  std::optional<Projection> projection;  ///< nothing: the map frame
  std::optional<GeoReference> georeference;

  Vec3 operator()(const Vec3& p_map) const {
    return projection ? (*projection)(map_to_geodetic(*georeference, p_map)) : p_map;
  }
  std::string wkt() const { return projection ? projection->wkt() : std::string(); }
};

/// What the intensities of the clouds are multiplied by to fit 16 bits: shares of one fill them,
/// what fits stays, what does not is scaled down.
double intensity_scale(float brightest) {
  if (brightest <= 1) return 65535;
  return brightest <= 65535 ? 1 : 65535 / brightest;
}

}  // namespace

class Las final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    static const std::string doc =
        std::string(map_export::crs_doc) + "; map: the map frame, without a system";
    v("crs", crs_, doc.c_str());
    v("voxel_size", voxel_size_, "One point is kept in each voxel of this width; 0 = all points",
      at_least(0, "m"));
    v("tile_size", tile_size_, "Width of the tiles that are worked on one after the other",
      between(5, 10000, "m"));
    v("tiled", tiled_, "One file per tile instead of one per island");
    v("classes", classes_,
      "labels: the clouds' labels as they are, 64 to 66 for trunk, branch and leaf; standard: "
      "these "
      "three as 5, high vegetation",
      one_of({"labels", "standard"}));
    v("colours", colours_, "Point format 7: each point has the colour of its mission");
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    if (crs_ != "map") Projection(map_export::crs_of(crs_, atlas)).require_plane();
    std::vector<std::filesystem::path> written;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      const auto g = georeference(atlas, atlas.islands[i]);
      if (!g && crs_ != "map") {
        context.warn(
            "island " + std::to_string(i) + " (mission " +
            atlas.missions[atlas.islands[i].missions.front()].mission->name +
            ") has no georeference and is not in the LAS files; add a georeference step, or "
            "set crs: map");
        continue;
      }
      write_island(atlas, i, g, folder, context, written);
    }
    return written;
  }

 private:
  void write_island(const Atlas& atlas, std::size_t i, const std::optional<GeoReference>& g,
                    const std::filesystem::path& folder, const Context& context,
                    std::vector<std::filesystem::path>& written) const {
    const auto& missions = atlas.islands[i].missions;
    const Tiles tiles = tiles_of(atlas, missions, tile_size_, context);
    System system{{}, g};
    if (crs_ != "map") system.projection.emplace(map_export::crs_of(crs_, atlas));
    std::optional<LasFile> file;
    std::size_t skipped = 0, visits = 0;
    for (const auto& [tile, nodes] : tiles.nodes) visits += nodes.size();
    context.expect(visits);
    for (const auto& [tile, nodes] : tiles.nodes) {
      const auto name =
          tiled_ ? island_file("map_" + std::to_string(tile[0]) + "_" + std::to_string(tile[1]), i,
                               ".las")
                 : island_file("map", i, ".las");
      if (!file) {
        written.push_back(folder / name);
        file.emplace(written.back(), header(atlas, missions, system));
      }
      skipped +=
          add_tile(atlas, tile, nodes, system, intensity_scale(tiles.brightest), *file, context);
      if (tiled_) file->commit(), file.reset();
    }
    if (file) file->commit();
    if (tiles.nodes.empty())
      context.warn("las: no node of island " + std::to_string(i) + " has a cloud");
    if (skipped > 0)
      context.warn("las: " + std::to_string(skipped) +
                   " points lie more than 2147 km from the first node; they are left out");
  }

  Header header(const Atlas& atlas, const std::vector<std::uint32_t>& missions,
                const System& system) const {
    Header h;
    h.colours = colours_;
    h.wkt = system.wkt();
    std::optional<Stamp> last;
    for (const std::uint32_t m : missions) {
      h.missions += std::to_string(m + 1) + " " + atlas.missions[m].mission->name + "\n";
      for (const Node& node : atlas.missions[m].mission->nodes)
        if (node.stamp && (!last || *node.stamp > *last)) last = node.stamp;
    }
    // Not the day of writing: the same map gives the same bytes.
    if (last) h.day = day_of(*last);
    const Vec3 first = system(atlas.T_map_node({missions.front(), 0}).t);
    for (int k = 0; k < 3; ++k) h.offset[k] = std::floor(first[k]);
    return h;
  }

  /// The points of one tile, in the order of missions and nodes; how many could not be stored.
  std::size_t add_tile(const Atlas& atlas, const Tile& tile, const std::vector<NodeRef>& nodes,
                       const System& system, double intensity, LasFile& file,
                       const Context& context) const {
    std::optional<map_export::VoxelSet> taken;
    if (voxel_size_ > 0) taken.emplace(voxel_size_);
    std::size_t skipped = 0;
    for (const NodeRef& node : nodes) {
      context.check_cancelled();
      context.advance();
      const auto cloud = atlas.payload(node).cloud;
      if (!cloud) continue;
      Point point = point_of(atlas, node);
      const SE3& T_map_node = atlas.T_map_node(node);
      for (std::size_t i = 0; i < cloud->size(); ++i) {
        const Vec3 p = T_map_node * Vec3(cloud->points().col(Eigen::Index(i)).cast<double>());
        if (!p.allFinite() || tile_at(p, tile_size_) != tile) continue;
        if (taken && taken->in_range(p) && !taken->insert(p)) continue;
        const double value = cloud->intensity.empty() ? 0 : intensity * cloud->intensity[i];
        point.intensity = std::uint16_t(std::lround(value > 0 ? std::min(value, 65535.0) : 0.0));
        point.classification = cloud->label.empty() ? 0 : class_of(cloud->label[i]);
        point.p = system(p);
        skipped += !file.add(point);
      }
    }
    return skipped;
  }

  std::uint8_t class_of(std::uint8_t label) const {
    constexpr std::uint8_t trunk = 64, leaf = 66, high_vegetation = 5;
    return classes_ == "standard" && label >= trunk && label <= leaf ? high_vegetation : label;
  }

  static Point point_of(const Atlas& atlas, const NodeRef& node) {
    Point point;
    point.source = std::uint16_t(std::min(node.mission + 1, 65535u));
    if (const auto& stamp = atlas.node(node).stamp) point.time = gps_time(*stamp);
    const auto& colour = palette[node.mission % std::size(palette)];
    for (int k = 0; k < 3; ++k) point.colour[k] = std::uint16_t(colour[k] * 257);
    return point;
  }

  std::string crs_ = "utm";
  double voxel_size_ = 0.05;
  double tile_size_ = 50;
  std::string classes_ = "labels";
  bool tiled_ = false;
  bool colours_ = false;
};

}  // namespace las

CAMBIUM_PLUGIN("las", "0.1.0") {
  registry.add<las::Las>("las",
                         "All clouds as LAS 1.4 in any EPSG code, for CloudCompare, QGIS, PDAL");
}
