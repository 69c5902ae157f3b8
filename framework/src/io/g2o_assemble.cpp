// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "cambium/dialect.hpp"
#include "cambium/error.hpp"
#include "cambium/files.hpp"
#include "io/g2o_parser.hpp"

namespace cambium {
namespace {

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
  accept_backward_odometry();
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
  auto& edges = mission_.edges;
  std::size_t own = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    Edge& edge = edges[k];
    if (belongs_to_another_robot(edge)) {
      warnings_.add(edge.line,
                    "the edge leads to another robot's vertex, which is not in this file; "
                    "it is kept and written back, but not used");
      keep(edge_text_[k], edge.line);
      continue;
    }
    if (own != k) edges[own] = std::move(edge);
    ++own;
  }
  edges.resize(own);
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

// hdl_graph_slam and others write the whole path backwards, each edge from a vertex to the one
// before it. Where no edge runs forwards, those are the odometry.
void G2oParser::accept_backward_odometry() {
  auto& edges = mission_.edges;
  const auto is_odometry = [](const Edge& e) { return e.kind == EdgeKind::odometry; };
  if (std::any_of(edges.begin(), edges.end(), is_odometry)) return;
  for (Edge& e : edges) {
    if (e.kind != EdgeKind::loop || e.head > e.tail || e.tail - e.head != 1) continue;
    e.kind = EdgeKind::odometry;
    warnings_.add(e.line,
                  "the edge runs from a vertex to the one before it, as all do in this file; "
                  "it is taken for odometry");
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
