// SPDX-License-Identifier: BSD-3-Clause
// Poses and clouds in any coordinate reference system, every point projected by itself.
#include <optional>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "cambium/projection.hpp"
#include "common/crs.hpp"
#include "common/payloads.hpp"
#include "common/voxel_set.hpp"
#include "grid_cloud.hpp"

namespace projected {
namespace {

using namespace cambium;

/// Where a pose of the map is in the grid. Its axes are those of the grid at that place: north of a
/// grid is not north. The scale of the grid is left out of the rotation.
SE3 in_grid(const Projection& to_grid, const GeoReference& g, const SE3& T_map_base) {
  const auto at = [&](const Vec3& p_map) { return to_grid(map_to_geodetic(g, p_map)); };
  constexpr double step = 5;  // [m]: digits of the projection against its curvature
  Mat4 T = Mat4::Identity();
  for (int axis = 0; axis < 3; ++axis)
    T.block<3, 1>(0, axis) =
        (at(T_map_base.t + step * Vec3::Unit(axis)) - at(T_map_base.t - step * Vec3::Unit(axis))) /
        (2 * step);
  SE3 T_grid_map = SE3::from_matrix(T);  // the nearest rotation
  return {T_grid_map.q * T_map_base.q, at(T_map_base.t)};
}

std::string pose_rows(const Projection& to_grid, const GeoReference& g, const MissionState& state) {
  std::string out;
  for (std::size_t i = 0; i < state.T_map_node->size(); ++i) {
    const Node& node = state.mission->nodes[i];
    const SE3 T = in_grid(to_grid, g, (*state.T_map_node)[i]);
    out += state.mission->name + ',' + std::to_string(node.id) + ',';
    if (node.stamp)
      out += std::to_string(node.stamp->sec) + ',' + std::to_string(node.stamp->nsec);
    else
      out += ',';
    for (int k = 0; k < 3; ++k) out += ',' + format_number(T.t[k]);
    for (int k = 0; k < 4; ++k) out += ',' + format_number(T.q.coeffs()[k]);
    out += '\n';
  }
  return out;
}

}  // namespace

class Projected final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("crs", crs_, map_export::crs_doc);
    v("clouds", clouds_, "Write the clouds, too");
    v("voxel_size", voxel_size_, "One point is kept in each voxel of this width", above(0, "m"));
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    const Projection to_grid(map_export::crs_of(crs_, atlas));
    to_grid.require_plane();
    std::vector<std::filesystem::path> written;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      const auto g = georeference(atlas, atlas.islands[i]);
      if (!g) {
        context.warn("island " + std::to_string(i) + " (mission " +
                     atlas.missions[atlas.islands[i].missions.front()].mission->name +
                     ") has no georeference and is not projected; add a georeference step");
        continue;
      }
      written.push_back(folder / island_file("poses", i, ".csv"));
      write_poses(atlas, atlas.islands[i], *g, to_grid, written.back());
      const auto cloud = folder / island_file("cloud", i, ".ply");
      if (clouds_ && write_cloud(atlas, atlas.islands[i], *g, to_grid, cloud, context))
        written.push_back(cloud);
    }
    return written;
  }

 private:
  static std::vector<std::string> remarks(const Projection& to_grid) {
    return {"crs: " + to_grid.crs() + " (" + to_grid.name() + ")", "heights: " + to_grid.heights()};
  }

  void write_poses(const Atlas& atlas, const Island& island, const GeoReference& g,
                   const Projection& to_grid, const std::filesystem::path& path) const {
    std::string text;
    for (const std::string& remark : remarks(to_grid)) text += "# " + remark + "\n";
    text += "mission,id,sec,nsec,easting,northing,height,qx,qy,qz,qw\n";
    for (const std::uint32_t m : island.missions) text += pose_rows(to_grid, g, atlas.missions[m]);
    write_file(path, text);
  }

  bool write_cloud(const Atlas& atlas, const Island& island, const GeoReference& g,
                   const Projection& to_grid, const std::filesystem::path& path,
                   const Context& context) const {
    std::optional<GridCloud> file;
    map_export::VoxelSet taken(voxel_size_);
    const auto nodes = map_export::nodes_with_payload(atlas, island.missions);
    map_export::for_each_payload(atlas, nodes, context, [&](NodeRef node, const Payload& payload) {
      if (!payload.cloud || payload.cloud->empty()) return;
      if (!file) file.emplace(path, remarks(to_grid));
      add(*payload.cloud, atlas.T_map_node(node), g, to_grid, taken, *file);
    });
    if (file) file->commit();
    return file.has_value();
  }

  static void add(const Cloud& cloud, const SE3& T_map_node, const GeoReference& g,
                  const Projection& to_grid, map_export::VoxelSet& taken, GridCloud& file) {
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Vec3 p_map = T_map_node * Vec3(cloud.points().col(Eigen::Index(i)).cast<double>());
      if (!taken.in_range(p_map) || !taken.insert(p_map)) continue;
      file.add(to_grid(map_to_geodetic(g, p_map)),
               cloud.intensity.empty() ? 0.0f : cloud.intensity[i]);
    }
  }

  std::string crs_ = "utm";
  bool clouds_ = true;
  double voxel_size_ = 0.1;
};

}  // namespace projected

CAMBIUM_PLUGIN("projected", "0.1.0") {
  registry.add<projected::Projected>(
      "projected", "Poses and clouds in any projected coordinate system (EPSG code), by PROJ");
}
