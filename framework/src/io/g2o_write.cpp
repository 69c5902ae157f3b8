// SPDX-License-Identifier: BSD-3-Clause
// One order of lines whatever the order of the input was: comments and unknown lines, what holds
// for the mission, vertices by id, edges in the order of the file. So writing is idempotent.
#include <charconv>
#include <ostream>

#include "cambium/dialect.hpp"

namespace cambium {
namespace {

/// Gathers text in blocks: a stream insertion per number would cost more than the number.
class Writer {
 public:
  explicit Writer(std::ostream& out) : out_(out) { buffer_.reserve(2 * block); }
  ~Writer() { flush(); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void begin(std::string_view tag) { buffer_.append(tag); }
  void field(std::string_view text) { (buffer_ += ' ').append(text); }
  template <class Number>
  void number(Number value) {
    char text[32];
    const auto result = std::to_chars(text, text + sizeof text, value);
    field({text, std::size_t(result.ptr - text)});
  }
  void pose(const SE3& T) {
    for (int i = 0; i < 3; ++i) number(T.t[i]);
    for (int i = 0; i < 4; ++i) number(T.q.coeffs()[i]);  // x y z w
  }
  void upper_triangle(const Mat6& information, int size) {
    for (int row = 0; row < size; ++row)
      for (int col = row; col < size; ++col) number(information(row, col));
  }
  void end() {
    buffer_ += '\n';
    if (buffer_.size() > block) flush();
  }

 private:
  void flush() {
    out_.write(buffer_.data(), std::streamsize(buffer_.size()));
    buffer_.clear();
  }
  static constexpr std::size_t block = 1 << 16;
  std::ostream& out_;
  std::string buffer_;
};

void write_mission_lines(Writer& w, const Mission& mission) {
  for (const RawLine& raw : mission.unknown_lines) {
    w.begin(raw.text);
    w.end();
  }
  if (mission.platform_id != 0) {
    w.begin("PLATFORM_ID");
    w.number(mission.platform_id);
    w.end();
  }
  if (!mission.georeference) return;
  const GeoReference& g = *mission.georeference;
  w.begin("GNSS_LLA_REF");
  for (const double value : {g.latitude, g.longitude, g.altitude}) w.number(value);
  w.end();
  w.begin("GNSS_LLA_TO_MAP");
  w.pose(g.T_map_enu);
  w.end();
}

void write_node(Writer& w, const Node& node) {
  w.begin(node.stamp ? "VERTEX_SE3:QUAT_TIME" : "VERTEX_SE3:QUAT");
  w.number(node.id);
  w.pose(node.T_mission_node);
  if (node.stamp) {
    w.number(node.stamp->sec);
    w.number(node.stamp->nsec);
  }
  w.end();
  if (!node.fixed) return;
  w.begin("FIX");
  w.number(node.id);
  w.end();
}

void write_edge(Writer& w, const Edge& edge) {
  if (edge.kind == EdgeKind::position) {
    w.begin("EDGE_SE3_PRIORXYZ");
    w.number(edge.tail);
    for (int i = 0; i < 3; ++i) w.number(edge.T_tail_head.t[i]);
    w.upper_triangle(edge.information, 3);
    return w.end();
  }
  const bool prior_line = edge.tag == "EDGE_SE3_PRIOR" && edge.kind == EdgeKind::prior;
  const bool has_extra = edge.tag == "EDGE_SE3_SWITCHABLE" || edge.tag == "EDGE_SE3_MAXMIX";
  w.begin(prior_line || (has_extra && !edge.extra.empty()) ? std::string_view(edge.tag)
                                                           : "EDGE_SE3:QUAT");
  w.number(edge.tail);
  if (!prior_line) w.number(edge.head);
  if ((prior_line || has_extra) && !edge.extra.empty()) w.field(edge.extra);
  w.pose(edge.T_tail_head);
  w.upper_triangle(edge.information, 6);
  w.end();
}

}  // namespace

void write_g2o(std::ostream& out, const Mission& mission) {
  Writer w(out);
  write_mission_lines(w, mission);
  for (const Node& node : mission.nodes) write_node(w, node);
  for (const Edge& edge : mission.edges) write_edge(w, edge);
}

}  // namespace cambium
