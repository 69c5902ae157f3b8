// SPDX-License-Identifier: BSD-3-Clause
// Georeferenced LAS and LAZ files as a mission: a node a file, at its place.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "cambium/dialect.hpp"
#include "cambium/plugin.hpp"
#include "common/odometry.hpp"
#include "tile_payload.hpp"

namespace las_tiles {

using namespace cambium;
namespace fs = std::filesystem;

namespace {

struct Tile {
  fs::path path;
  las::Header header;
  Vec3 middle = Vec3::Zero();  ///< of the plan, at the lowest height; in the files' coordinates
};

bool is_las(const fs::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = char(std::tolower(static_cast<unsigned char>(c)));
  return (extension == ".las" || extension == ".laz") && fs::is_regular_file(path);
}

/// By name; a folder that is a mission in another way has none.
std::vector<fs::path> files_of(const fs::path& path) {
  if (is_las(path)) return {path};
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator it(path, error), end; !error && it != end; it.increment(error)) {
    if (it->path().filename().string().starts_with("slam_pose_graph.")) return {};
    if (is_las(it->path())) out.push_back(it->path());
  }
  std::sort(out.begin(), out.end());
  return out;
}

Vec3 middle_of(const las::Header& h, const fs::path& path) {
  for (std::size_t k = 0; k < 3; ++k)
    if (!std::isfinite(h.low[k]) || !std::isfinite(h.high[k]) || h.low[k] > h.high[k])
      throw Error(ErrorCode::data, path.string(),
                  "the extent in its header is none: from " + std::to_string(h.low[k]) + " to " +
                      std::to_string(h.high[k]));
  return {(h.low[0] + h.high[0]) / 2, (h.low[1] + h.high[1]) / 2, h.low[2]};
}

/// The day of the header and, as seconds, the number of the tile.
std::optional<Stamp> stamp_of(const las::Header& h, std::size_t tile) {
  using namespace std::chrono;
  if (h.year < 1970 || h.year > 2200 || h.day < 1 || h.day > 366) return std::nullopt;
  const sys_days day = sys_days(year(h.year) / 1 / 1) + days(h.day - 1);
  return Stamp{duration_cast<seconds>(day.time_since_epoch()).count() + std::int64_t(tile), 0};
}

}  // namespace

class LasTiles final : public MissionReader {
 public:
  void params(ParamVisitor& v) override {
    v("crs", crs_,
      "Coordinate reference system of the files, as PROJ names it, where they state none or a "
      "wrong one; empty: as they state");
    v("sigma_position", sigma_position_, "Of a tile against the next one", above(0, "m"));
    v("sigma_rotation", sigma_rotation_, "Of a tile against the next one", above(0, "rad"));
    v("sigma_fix", sigma_fix_, "Of the place of a tile on the globe, each of east, north, up",
      above(0, "m"));
  }

  bool accepts(const fs::path& path) const override { return !files_of(path).empty(); }

  Mission read(const fs::path& path, const Context& context) const override {
    Mission mission;
    const fs::path full = fs::absolute(path).lexically_normal();
    const bool file = is_las(path);
    mission.folder = file ? path.parent_path() : path;
    mission.graph_file = path;
    mission.name = file ? path.stem().string()
                        : (full.has_filename() ? full : full.parent_path()).filename().string();
    const auto tiles = tiles_of(path, mission.warnings, context);
    const Frame frame = frame_of(tiles, mission.warnings);
    try {
      add_nodes(tiles, frame, mission);
    } catch (const Error& error) {
      if (error.code() != ErrorCode::numeric) throw;
      throw Error(ErrorCode::data, path.string(), error.message());
    }
    mission.digest = mission_digest(mission);
    return mission;
  }

 private:
  static std::vector<Tile> tiles_of(const fs::path& path, std::vector<std::string>& warnings,
                                    const Context& context) {
    std::vector<Tile> out;
    for (const fs::path& file : files_of(path)) {
      context.check_cancelled();
      Tile tile{file, las::read_header(file), {}};
      if (tile.header.points == 0) {
        warnings.push_back(file.string() + ": has no points; it is left out");
        continue;
      }
      tile.middle = middle_of(tile.header, file);
      out.push_back(std::move(tile));
    }
    if (out.empty())
      throw Error(ErrorCode::data, path.string(),
                  "holds no LAS or LAZ file with points; expected one, or a folder of tiles");
    return out;
  }

  Frame frame_of(const std::vector<Tile>& tiles, std::vector<std::string>& warnings) const {
    Frame frame;
    frame.crs = crs_;
    // Whole metres: the same tile gives the same frame, whatever its last digits.
    for (int k = 0; k < 3; ++k) frame.origin[k] = std::floor(tiles.front().middle[k]);
    if (!crs_.empty()) return frame;
    for (const Tile& tile : tiles)
      if (tile.header.crs != tiles.front().header.crs)
        throw Error(ErrorCode::data, tile.path.string(),
                    "is in another coordinate reference system than " +
                        tiles.front().path.filename().string() +
                        "; name one for all by the reader's parameter crs");
    if (tiles.front().header.crs.empty())
      warnings.push_back(tiles.front().path.string() +
                         ": states no coordinate reference system, so the mission is not on the "
                         "globe; name one by the reader's parameter crs");
    else
      frame.crs =
          usable_crs(tiles.front().header.crs, frame.origin, tiles.front().path.string(), warnings);
    return frame;
  }

  void add_nodes(const std::vector<Tile>& tiles, const Frame& frame, Mission& mission) const {
    const ToMission to_mission(frame);
    mission.georeference = to_mission.georeference();
    for (const Tile& tile : tiles) {
      Node node;
      node.id = NodeId(mission.nodes.size());
      node.stamp = stamp_of(tile.header, mission.nodes.size());
      node.T_mission_node.t = to_mission(tile.middle);
      node.payload =
          std::make_shared<TilePayload>(tile.path, tile.header, frame, node.T_mission_node.t);
      if (mission.georeference && node.stamp) add_fix(node, mission);
      if (!mission.nodes.empty())
        mission.edges.push_back(
            odometry_edge(mission.nodes.back(), node, sigma_position_, sigma_rotation_));
      mission.nodes.push_back(std::move(node));
    }
  }

  void add_fix(const Node& node, Mission& mission) const {
    const Geodetic g = map_to_geodetic(*mission.georeference, node.T_mission_node.t);
    mission.fixes.push_back({*node.stamp, g.latitude, g.longitude, g.altitude,
                             Mat3::Identity() * (sigma_fix_ * sigma_fix_)});
  }

  std::string crs_;
  double sigma_position_ = 0.05, sigma_rotation_ = 1e-4, sigma_fix_ = 0.1;
};

}  // namespace las_tiles

CAMBIUM_PLUGIN("las_tiles", "0.1.0") {
  registry.add<las_tiles::LasTiles>("las_tiles",
                                    "Georeferenced LAS and LAZ files, or folders of them");
}
