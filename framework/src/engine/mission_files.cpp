// SPDX-License-Identifier: BSD-3-Clause
#include "engine/mission_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

constexpr auto durability = AtomicFile::Durability::rename_only;

void write_text(const fs::path& path, std::string_view text) {
  AtomicFile file(path, durability);
  file.stream() << text;
  file.commit();
}

std::string pcd_header(const Cloud& cloud) {
  std::string fields = "x y z", sizes = "4 4 4", types = "F F F", counts = "1 1 1";
  const auto add = [&](const char* names, const char* size, const char* type, const char* count) {
    fields += names, sizes += size, types += type, counts += count;
  };
  if (!cloud.normals.empty()) add(" normal_x normal_y normal_z", " 4 4 4", " F F F", " 1 1 1");
  if (!cloud.intensity.empty()) add(" intensity", " 4", " F", " 1");
  if (!cloud.label.empty()) add(" label", " 1", " U", " 1");
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS {1}\nSIZE {2}\nTYPE {3}\n"
      "COUNT {4}\nWIDTH {0}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {0}\nDATA binary\n",
      cloud.size(), fields, sizes, types, counts);
}

void write_picture(const Image& image, const Stamp& stamp, const fs::path& folder) {
  fs::create_directories(folder / "individual_images");
  write_text(folder / "individual_images" /
                 stamped("image", stamp, image.file.extension().string().c_str()),
             read_file(image.file));
}

WrittenMission write_payload(const Payload& payload, const Stamp& stamp, const fs::path& folder) {
  WrittenMission out;
  if (payload.cloud) {
    write_cloud(*payload.cloud, stamp, folder);
    out.clouds = 1, out.points = payload.cloud->size();
  }
  if (payload.trees) write_trees(*payload.trees, stamp, folder), out.tree_tables = 1;
  if (payload.images && !payload.images->empty()) {
    write_picture(payload.images->front(), stamp, folder);
    out.pictures = 1, out.other_pictures = payload.images->size() - 1;
  }
  if (payload.imu) out.inertial = payload.imu->size();
  return out;
}

}  // namespace

WrittenMission& WrittenMission::operator+=(const WrittenMission& other) {
  clouds += other.clouds, points += other.points, tree_tables += other.tree_tables;
  pictures += other.pictures, other_pictures += other.other_pictures, inertial += other.inertial;
  return *this;
}

std::string stamped(const char* prefix, const Stamp& s, const char* extension) {
  return fmt::format("{}_{}_{:09}{}", prefix, s.sec, s.nsec, extension);
}

void write_cloud(const Cloud& cloud, const Stamp& stamp, const fs::path& folder) {
  std::string bytes = pcd_header(cloud);
  const auto add = [&](const std::vector<float>& values, std::size_t i, std::size_t columns) {
    if (values.empty()) return;
    bytes.append(reinterpret_cast<const char*>(values.data() + columns * i),
                 columns * sizeof(float));
  };
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    add(cloud.xyz, i, 3), add(cloud.normals, i, 3), add(cloud.intensity, i, 1);
    if (!cloud.label.empty()) bytes.push_back(char(cloud.label[i]));
  }
  fs::create_directories(folder / "individual_clouds");
  write_text(folder / "individual_clouds" / stamped("cloud", stamp, ".pcd"), bytes);
}

void write_trees(const std::vector<Tree>& trees, const Stamp& stamp, const fs::path& folder) {
  std::string text = "x,y,z,axis_x,axis_y,axis_z,dbh,score,reconstructed\n";
  for (const Tree& t : trees)
    fmt::format_to(
        std::back_inserter(text), "{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{},{:.2f},{}\n",
        t.base.x(), t.base.y(), t.base.z(), t.axis.x(), t.axis.y(), t.axis.z(),
        std::isnan(t.dbh) ? "" : fmt::format("{:.3f}", t.dbh), t.score, int(t.reconstructed));
  fs::create_directories(folder / "individual_trees");
  write_text(folder / "individual_trees" / stamped("trees", stamp, ".csv"), text);
}

void write_fixes(const std::vector<GnssFix>& fixes, const fs::path& folder) {
  const bool independent = std::all_of(fixes.begin(), fixes.end(), [](const GnssFix& f) {
    return f.covariance.isDiagonal() && f.covariance.diagonal().minCoeff() >= 1e-6;
  });
  std::string text = independent
                         ? "sec,nsec,lat,lon,alt,sd_e,sd_n,sd_u\n"
                         : "sec,nsec,lat,lon,alt,cov_ee,cov_en,cov_eu,cov_nn,cov_nu,cov_uu\n";
  for (const GnssFix& f : fixes) {
    fmt::format_to(std::back_inserter(text), "{},{},{:.9f},{:.9f},{:.3f}", f.stamp.sec,
                   f.stamp.nsec, f.latitude, f.longitude, f.altitude);
    for (int i = 0; i < 3; ++i)
      if (independent)
        text += fmt::format(",{:.3f}", std::sqrt(f.covariance(i, i)));
      else
        for (int j = i; j < 3; ++j) text += ',' + format_number(f.covariance(i, j));
    text += '\n';
  }
  write_text(folder / "gnss.csv", text);
}

WrittenMission write_mission(const Mission& mission, const fs::path& folder, const Engine& engine) {
  AtomicFile graph(folder / "slam_pose_graph.g2o", durability);
  write_g2o(graph.stream(), mission);
  graph.commit();
  if (!mission.fixes.empty()) write_fixes(mission.fixes, folder);
  std::vector<WrittenMission> written(mission.nodes.size());
  engine.progress().begin("write " + mission.name);
  engine.progress().expect(mission.nodes.size());
  engine.parallel_for(mission.nodes.size(), [&](std::size_t i) {
    const Node& node = mission.nodes[i];
    if (engine.cancelled()) throw Cancelled();
    if (node.payload && !node.stamp)
      throw Error(
          ErrorCode::data, node.payload->where(),
          fmt::format("node {} has no stamp, by which files of a mission are named", node.id));
    if (node.payload) written[i] = write_payload(node.payload->load(), *node.stamp, folder);
    engine.progress().advance();
  });
  WrittenMission sum;
  for (const WrittenMission& w : written) sum += w;
  engine.progress().end(
      fmt::format("{} nodes, {} clouds, {} points", mission.nodes.size(), sum.clouds, sum.points));
  return sum;
}

}  // namespace cambium
