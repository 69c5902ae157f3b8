// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "io/g2o_parser.hpp"

namespace cambium {
namespace {

bool same_pose(const SE3& a, const SE3& b) { return a.t == b.t && a.q.coeffs() == b.q.coeffs(); }

// GTSAM writes the robot's letter into the top byte of an id; plain ids have none.
int robot_of(NodeId id) { return int(id >> 56); }

std::string no_vertex_message(const Mission& mission) {
  std::string message = "holds no vertex, expected lines VERTEX_SE3:QUAT_TIME or VERTEX_SE3:QUAT";
  for (const RawLine& raw : mission.unknown_lines)
    if (raw.text.starts_with("VERTEX_SE2"))
      return message + fmt::format("; line {} is of a planar graph", raw.line);
  return message;
}

}  // namespace

void G2oParser::fail(int line, const std::string& message) const {
  throw Error(ErrorCode::data, LineOrigin{file_, line}.where(), message);
}

Mission G2oParser::finish() && {
  if (mission_.nodes.empty())
    throw Error(ErrorCode::data, file_.string(), no_vertex_message(mission_));
  order_nodes();
  mark_fixed();
  check_edges();
  apply_offsets();
  make_georeference();
  std::stable_sort(mission_.unknown_lines.begin(), mission_.unknown_lines.end(),
                   [](const RawLine& a, const RawLine& b) { return a.line < b.line; });
  mission_.name = file_.stem().string();
  mission_.folder = file_.parent_path();
  mission_.graph_file = file_;
  mission_.warnings = warnings_.list(file_);
  mission_.digest = mission_digest(mission_);
  return std::move(mission_);
}

void G2oParser::order_nodes() {
  auto& nodes = mission_.nodes;
  const auto by_id = [](const Node& a, const Node& b) { return a.id < b.id; };
  if (!std::is_sorted(nodes.begin(), nodes.end(), by_id))
    std::stable_sort(nodes.begin(), nodes.end(), by_id);
  std::size_t last = 0;
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    if (nodes[i].id == nodes[last].id)
      merge_repeated(nodes[last], nodes[i]);
    else if (++last != i)
      nodes[last] = std::move(nodes[i]);
  }
  nodes.resize(last + 1);
}

void G2oParser::merge_repeated(Node& first, const Node& second) {
  const bool same_stamp = !first.stamp || !second.stamp || first.stamp == second.stamp;
  if (!same_pose(first.T_mission_node, second.T_mission_node) || !same_stamp)
    fail(second.line,
         fmt::format("vertex {} has another pose or stamp in line {}; keep one of them", first.id,
                     first.line));
  if (!first.stamp) first.stamp = second.stamp;
  warnings_.add(second.line, "the vertex is a copy of an earlier line and was left out");
}

void G2oParser::mark_fixed() {
  for (const auto& [id, line] : fixed_) {
    const auto index = mission_.index_of(id);
    if (!index) fail(line, fmt::format("FIX names vertex {}, which the file does not define", id));
    mission_.nodes[*index].fixed = true;
  }
}

void G2oParser::check_edges() {
  std::vector<Edge> own;
  own.reserve(mission_.edges.size());
  for (std::size_t k = 0; k < mission_.edges.size(); ++k) {
    Edge& edge = mission_.edges[k];
    if (belongs_to_another_robot(edge)) {
      warnings_.add(edge.line,
                    "the edge leads to another robot's vertex, which is not in this file; "
                    "it is kept and written back, but not used");
      keep(edge_text_[k], edge.line);
      continue;
    }
    own.push_back(std::move(edge));
  }
  mission_.edges = std::move(own);
}

// Each file of a distributed graph also holds the edges to its partners' vertices.
bool G2oParser::belongs_to_another_robot(const Edge& edge) const {
  const bool has_tail = mission_.index_of(edge.tail).has_value();
  const bool has_head = mission_.index_of(edge.head).has_value();
  if (has_tail && has_head) return false;
  const int tail_robot = robot_of(edge.tail), head_robot = robot_of(edge.head);
  if (has_tail != has_head && tail_robot != head_robot && tail_robot != 0 && head_robot != 0)
    return true;
  fail(edge.line, fmt::format("{} names vertex {}, which the file does not define", edge.tag,
                              has_tail ? edge.head : edge.tail));
}

// EDGE_SE3_PRIOR measures T_mission_sensor = T_mission_node * T_base_sensor. A prior of the node
// says the same: with d_sensor = J d_node (translation in the mission frame, rotation in the
// body's), J = [I, -R_mission_node [t_base_sensor]x; 0, R_base_sensor'], its information is J'
// Omega J.
void G2oParser::apply_offsets() {
  for (Edge& edge : mission_.edges) {
    if (edge.tag != "EDGE_SE3_PRIOR" || edge.extra.empty()) continue;
    const auto offset = T_base_sensor_.find(std::stoll(edge.extra));
    if (offset == T_base_sensor_.end()) {
      warnings_.add(edge.line,
                    "EDGE_SE3_PRIOR names an offset that no PARAMS_SE3OFFSET line defines; "
                    "none was applied");
      continue;
    }
    const SE3& T_base_sensor = offset->second;
    if (same_pose(T_base_sensor, SE3{})) continue;
    const SE3 T_mission_node = edge.T_tail_head * T_base_sensor.inverse();
    Mat6 J = Mat6::Identity();
    // The upper right block of an adjoint is [t]x R: with R = I it is [t]x.
    J.topRightCorner<3, 3>() =
        -T_mission_node.rotation() *
        SE3{Quat::Identity(), T_base_sensor.t}.adjoint().topRightCorner<3, 3>();
    J.bottomRightCorner<3, 3>() = T_base_sensor.rotation().transpose();
    edge.T_tail_head = T_mission_node;
    const Mat6 information = J.transpose() * edge.information * J;
    edge.information = information.selfadjointView<Eigen::Upper>();  // exact symmetry
    edge.tag = "EDGE_SE3:QUAT";
    edge.extra.clear();
    warnings_.add(edge.line,
                  "EDGE_SE3_PRIOR with a sensor offset is written back as an equivalent "
                  "prior of the base frame");
  }
}

void G2oParser::make_georeference() {
  if (reference_line_ != 0 && transform_line_ != 0) {
    mission_.georeference = georeference_;
  } else if (reference_line_ != 0) {
    keep(reference_text_, reference_line_);
    warnings_.add(reference_line_,
                  "GNSS_LLA_REF without GNSS_LLA_TO_MAP does not place the map; it is "
                  "kept and written back, but not used");
  } else if (transform_line_ != 0) {
    keep(transform_text_, transform_line_);
    warnings_.add(transform_line_,
                  "GNSS_LLA_TO_MAP without GNSS_LLA_REF does not place the map; it is "
                  "kept and written back, but not used");
  }
}

Mission parse_g2o(std::string_view text, const std::filesystem::path& where) {
  G2oParser parser(where);
  std::size_t nodes = text.starts_with('V'), edges = text.starts_with('E');
  for (std::size_t at = text.find('\n'); at + 1 < text.size() && at != text.npos;
       at = text.find('\n', at + 1)) {
    nodes += text[at + 1] == 'V';
    edges += text[at + 1] == 'E';
  }
  parser.reserve(nodes, edges);
  for_each_line(text, where, [&](std::string_view line, const LineOrigin& origin) {
    parser.line(line, origin);
  });
  return std::move(parser).finish();
}

Mission read_g2o(const std::filesystem::path& path) { return parse_g2o(read_file(path), path); }

}  // namespace cambium
