// SPDX-License-Identifier: BSD-3-Clause
// One robot's recording, as it was read. Immutable once shared.
#pragma once
#include <compare>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cambium/payload.hpp"
#include "cambium/se3.hpp"

namespace cambium {

using NodeId = std::int64_t;

/// A named figure beside a result: "overlap", "rmse", ...
using Score = std::pair<std::string, double>;

struct Stamp {
  std::int64_t sec = 0;
  std::int32_t nsec = 0;  ///< 0..999 999 999
  friend auto operator<=>(const Stamp&, const Stamp&) = default;
  double seconds() const { return double(sec) + 1e-9 * nsec; }
};

/// A pose along the path of the robot.
struct Node {
  NodeId id = 0;
  std::optional<Stamp> stamp;
  SE3 T_mission_node;   ///< base frame in the mission's own frame, as the robot estimated it
  bool fixed = false;   ///< a FIX line named it
  int line = 0;         ///< in Mission::graph_file, 1-based; 0 = not from a file
  std::shared_ptr<const PayloadSource> payload;  ///< null: the node has none
};

enum class EdgeKind {
  odometry,  ///< head = tail + 1
  loop,      ///< any other pair
  prior,     ///< unary pose prior; head = tail, T_tail_head holds T_mission_node
  position,  ///< unary position prior; only T_tail_head.t and the upper left 3x3 block count
};

/// A constraint between two nodes of one mission.
struct Edge {
  EdgeKind kind = EdgeKind::odometry;
  NodeId tail = 0, head = 0;
  SE3 T_tail_head;
  Mat6 information = Mat6::Identity();  ///< of (translation [m]; rotation [rad])
  std::string tag;                      ///< the word that opened the line in the file
  std::string extra;                    ///< tokens of the tag that the model does not use
  int line = 0;                         ///< in Mission::graph_file; 0 = not from a file
};

/// One GNSS measurement, WGS 84.
struct GnssFix {
  Stamp stamp;
  double latitude = 0, longitude = 0;  ///< [deg]
  double altitude = 0;                 ///< above the ellipsoid [m]
  Mat3 covariance = Mat3::Identity();  ///< east, north, up [m^2]
};

/// Ties a map frame to the earth: p_map = T_map_enu * p_enu, ENU tangent at the reference point.
struct GeoReference {
  double latitude = 0, longitude = 0;  ///< [deg]
  double altitude = 0;                 ///< above the ellipsoid [m]
  SE3 T_map_enu;
  double sigma_yaw = 0;       ///< [rad]; 0 = not stated
  double sigma_position = 0;  ///< horizontal [m]; 0 = not stated
};

/// A line of the pose graph file that the model has no place for; it is written back.
struct RawLine {
  int line = 0;
  std::string text;
};

struct Mission {
  std::string name;
  std::filesystem::path folder;      ///< where its files are
  std::filesystem::path graph_file;  ///< the pose graph that was read
  int platform_id = 0;
  std::vector<Node> nodes;  ///< in order of their ids
  std::vector<Edge> edges;  ///< in order of the file
  std::optional<GeoReference> georeference;
  std::vector<GnssFix> fixes;
  std::vector<RawLine> unknown_lines;  ///< comments are among them
  std::vector<std::string> warnings;   ///< `file:line: message`, what a user should know
  Digest digest;                       ///< of everything above except the payloads

  /// Index of a node in `nodes`, or nothing. O(log n).
  std::optional<std::size_t> index_of(NodeId id) const;
};

}  // namespace cambium
