// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cambium/error.hpp"
#include "io/g2o_parser.hpp"
#include "io/pose_fields.hpp"

namespace cambium {

void G2oParser::reserve(std::size_t nodes, std::size_t edges) {
  mission_.nodes.reserve(nodes);
  mission_.edges.reserve(edges);
  edge_text_.reserve(edges);
}

void G2oParser::line(std::string_view text, const LineOrigin& origin) {
  if (text[0] == '#') return keep(text, origin.line);
  Fields fields(text, origin);
  const std::string_view tag = fields.word();
  if (tag == "EDGE_SE3:QUAT") return relative_edge(fields, tag, 0);
  if (tag == "VERTEX_SE3:QUAT" || tag == "VERTEX_SE3:QUAT_TIME" ||
      tag == "VERTEX_SE3_SE3:QUAT_TIME")
    return vertex(fields, tag);
  if (tag == "EDGE_SE3_SWITCHABLE" || tag == "EDGE_SE3_MAXMIX")
    return relative_edge(fields, tag, 1);
  if (tag == "EDGE_SE3_PRIOR") return pose_prior(fields);
  if (tag == "EDGE_SE3_PRIORXYZ") return position_prior(fields);
  if (tag == "PARAMS_SE3OFFSET") return offset(fields);
  if (tag == "PLATFORM_ID") return platform(fields);
  if (tag == "GNSS_LLA_REF") return gnss_reference(fields);
  if (tag == "GNSS_LLA_TO_MAP") return gnss_transform(fields);
  if (tag == "FIX") return fix(fields);
  unknown(tag, text, origin.line);
}

void G2oParser::vertex(Fields& fields, std::string_view tag) {
  const bool stamped = tag != "VERTEX_SE3:QUAT";
  fields.expect(stamped ? 11 : 9);
  Node node;
  node.line = fields.origin().line;
  node.id = fields.integer("a vertex id");
  node.T_mission_node = read_pose(fields, warnings_);
  if (stamped) {
    const std::int64_t sec = fields.integer("seconds");
    const std::int64_t nsec = fields.integer("nanoseconds");
    if (nsec > 999'999'999)
      fields.fail(fmt::format("found {} nanoseconds, expected 0 to 999999999", nsec));
    node.stamp = Stamp{sec, std::int32_t(nsec)};
  }
  mission_.nodes.push_back(std::move(node));
}

void G2oParser::relative_edge(Fields& fields, std::string_view tag, int extra_fields) {
  Edge edge;
  edge.line = fields.origin().line;
  edge.tag = tag;
  edge.tail = fields.integer("a vertex id");
  edge.head = fields.integer("a vertex id");
  if (extra_fields > 0) edge.extra = fields.word();
  pose_and_information(fields, edge);
  edge.kind = edge.head == edge.tail                                ? EdgeKind::prior
              : edge.head > edge.tail && edge.head - edge.tail == 1 ? EdgeKind::odometry
                                                                    : EdgeKind::loop;
  mission_.edges.push_back(std::move(edge));
  edge_text_.push_back(fields.line());
}

// With or without the id of a PARAMS_SE3OFFSET line before the pose.
void G2oParser::pose_prior(Fields& fields) {
  Edge edge;
  edge.line = fields.origin().line;
  edge.kind = EdgeKind::prior;
  edge.tag = "EDGE_SE3_PRIOR";
  edge.tail = edge.head = fields.integer("a vertex id");
  const int count = fields.count();
  if (count == 10 || count == 31) edge.extra = std::to_string(fields.integer("an offset id"));
  pose_and_information(fields, edge);
  mission_.edges.push_back(std::move(edge));
  edge_text_.push_back(fields.line());
}

void G2oParser::pose_and_information(Fields& fields, Edge& edge) {
  // What stands before the pose: the tag, one or two ids, what the tag adds.
  const int before = (edge.kind == EdgeKind::prior ? 2 : 3) + (edge.extra.empty() ? 0 : 1);
  fields.expect(before + 7, before + 28);  // without or with information
  edge.T_tail_head = read_pose(fields, warnings_);
  if (!fields.more()) {
    warnings_.add(edge.line, edge.tag + " without information; identity was taken");
    return;
  }
  double upper[21];
  fields.numbers(upper, 21);
  edge.information = read_information(upper, edge.line, warnings_);
}

void G2oParser::position_prior(Fields& fields) {
  Edge edge;
  edge.line = fields.origin().line;
  edge.kind = EdgeKind::position;
  edge.tag = "EDGE_SE3_PRIORXYZ";
  fields.expect(5, 11);  // without or with information
  edge.tail = edge.head = fields.integer("a vertex id");
  fields.numbers(edge.T_tail_head.t.data(), 3);
  double upper[6] = {1, 0, 0, 1, 0, 1};
  if (fields.more())
    fields.numbers(upper, 6);
  else
    warnings_.add(edge.line, edge.tag + " without information; identity was taken");
  const double wide[21] = {upper[0], upper[1], upper[2], 0, 0, 0,
                           upper[3], upper[4], 0,        0, 0, upper[5]};
  edge.information = read_information(wide, edge.line, warnings_);
  mission_.edges.push_back(std::move(edge));
  edge_text_.push_back(fields.line());
}

void G2oParser::offset(Fields& fields) {
  fields.expect(9);
  const std::int64_t id = fields.integer("an offset id");
  const SE3 T_base_sensor = read_pose(fields, warnings_);
  if (!T_base_sensor_.emplace(id, T_base_sensor).second)
    fields.fail(fmt::format("the offset {} was already given; keep one of the lines", id));
  keep(fields.line(), fields.origin().line);
}

void G2oParser::only_once(const Fields& fields, std::string_view tag, int& seen_line) const {
  if (seen_line != 0)
    fields.fail(
        fmt::format("a second {}, the first is in line {}; keep one of them", tag, seen_line));
  seen_line = fields.origin().line;
}

void G2oParser::platform(Fields& fields) {
  only_once(fields, "PLATFORM_ID", platform_line_);
  fields.expect(2);
  const std::int64_t id = fields.integer("a platform number");
  if (id > std::numeric_limits<int>::max())
    fields.fail(fmt::format("found platform {}, expected at most 2^31 - 1", id));
  mission_.platform_id = int(id);
}

void G2oParser::gnss_reference(Fields& fields) {
  only_once(fields, "GNSS_LLA_REF", reference_line_);
  fields.expect(4);
  reference_text_ = fields.line();
  georeference_.latitude = fields.number();
  georeference_.longitude = fields.number();
  georeference_.altitude = fields.number();
  if (std::abs(georeference_.latitude) > 90 || std::abs(georeference_.longitude) > 360)
    fields.fail("expected latitude -90..90 and longitude -360..360 in degrees, in this order");
}

void G2oParser::gnss_transform(Fields& fields) {
  only_once(fields, "GNSS_LLA_TO_MAP", transform_line_);
  fields.expect(8);
  transform_text_ = fields.line();
  georeference_.T_map_enu = read_pose(fields, warnings_);
}

void G2oParser::fix(Fields& fields) {
  do fixed_.emplace_back(fields.integer("a vertex id"), fields.origin().line);
  while (fields.more());
}

void G2oParser::unknown(std::string_view tag, std::string_view text, int line) {
  if (find_binary(text) != text.npos)
    fail(line, "binary data, expected text; the file is damaged from this line on");
  warnings_.add(line,
                fmt::format("'{}' lines are kept and written back, but not used", quoted(tag)));
  keep(text, line);
}

}  // namespace cambium
