// SPDX-License-Identifier: BSD-3-Clause
#include <memory>
#include <string>

#include "cambium/fused.hpp"
#include "cambium/plugin.hpp"
#include "common/payloads.hpp"
#include "common/voxel_set.hpp"
#include "point_file.hpp"

namespace cloud {
namespace {

using namespace cambium;

/// The clouds of some missions in one file. Holds one batch of clouds and a bit per voxel.
class MapFile {
 public:
  MapFile(const std::filesystem::path& path, PointFile::Format format, bool with_intensity,
          double voxel_size)
      : file_(path, format, with_intensity), taken_(voxel_size) {}

  void add(const Cloud& cloud, const SE3& T_map_node) {
    const Eigen::Matrix3d R = T_map_node.rotation();
    const auto points = cloud.points();
    for (Eigen::Index i = 0; i < points.cols(); ++i) {
      const Vec3 p_map = R * points.col(i).cast<double>() + T_map_node.t;
      if (!taken_.in_range(p_map))
        ++skipped_;
      else if (taken_.insert(p_map))
        file_.add(p_map, cloud.intensity.empty() ? 0.0f : cloud.intensity[std::size_t(i)]);
    }
  }

  void commit(const std::string& name, const Context& context) {
    if (skipped_ > 0)
      context.warn(name + ": " + std::to_string(skipped_) +
                   " points are not finite or lie more than 16 million voxels from the origin; "
                   "they are left out");
    file_.commit();
  }

 private:
  PointFile file_;
  map_export::VoxelSet taken_;
  std::size_t skipped_ = 0;
};

/// One file to write: the missions in it.
struct Share {
  std::string name;
  std::vector<std::uint32_t> missions;
};

}  // namespace

class CloudExporter final : public MapExporter {
 public:
  void params(ParamVisitor& v) override {
    v("voxel_size", voxel_size_, "One point is kept in each voxel of this width", above(0, "m"));
    v("format", format_, "File format, both binary", one_of({"ply", "pcd"}));
    v("per_mission", per_mission_, "One file per mission instead of one per island");
  }

  std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                           const Context& context) const override {
    std::vector<std::filesystem::path> written;
    for (const Share& share : shares(atlas)) {
      const auto nodes = map_export::nodes_with_payload(atlas, share.missions);
      if (write_share(atlas, nodes, folder / share.name, context))
        written.push_back(folder / share.name);
      else
        context.warn(share.name + " is not written: no node of its missions has a cloud");
    }
    return written;
  }

 private:
  std::vector<Share> shares(const Atlas& atlas) const {
    std::vector<Share> out;
    for (std::size_t i = 0; i < atlas.islands.size(); ++i) {
      if (!per_mission_) {
        out.push_back({island_file("cloud", i, "." + format_), atlas.islands[i].missions});
        continue;
      }
      for (const std::uint32_t m : atlas.islands[i].missions)
        out.push_back({"cloud_" + atlas.missions[m].mission->name + "." + format_, {m}});
    }
    return out;
  }

  bool write_share(const Atlas& atlas, const std::vector<NodeRef>& nodes,
                   const std::filesystem::path& path, const Context& context) const {
    std::unique_ptr<MapFile> map;
    // In the order of the nodes: the first point of a voxel is kept.
    map_export::for_each_payload(atlas, nodes, context, [&](NodeRef node, const Payload& payload) {
      const auto& cloud = payload.cloud;
      if (!cloud || cloud->empty()) return;
      // The first cloud says whether there are intensities.
      if (!map)
        map = std::make_unique<MapFile>(
            path, format_ == "ply" ? PointFile::Format::ply : PointFile::Format::pcd,
            !cloud->intensity.empty(), voxel_size_);
      map->add(*cloud, atlas.T_map_node(node));
    });
    if (map) map->commit(path.filename().string(), context);
    return map != nullptr;
  }

  double voxel_size_ = 0.1;
  std::string format_ = "ply";
  bool per_mission_ = false;
};

}  // namespace cloud

CAMBIUM_PLUGIN("cloud", "0.1.0") {
  registry.add<cloud::CloudExporter>("cloud", "All clouds in the map frame, one point per voxel");
}
