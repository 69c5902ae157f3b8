// SPDX-License-Identifier: BSD-3-Clause
// The lines of the g2o dialect (docs/formats.md), one method a kind of line.
#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "cambium/mission.hpp"
#include "io/fields.hpp"
#include "io/warnings.hpp"

namespace cambium {

/// To the last bit, not up to the sign of the quaternion.
inline bool same_pose(const SE3& a, const SE3& b) {
  return a.t == b.t && a.q.coeffs() == b.q.coeffs();
}

class G2oParser {
 public:
  explicit G2oParser(const std::filesystem::path& file) : file_(file) {}

  void reserve(std::size_t nodes, std::size_t edges);
  void line(std::string_view text, const LineOrigin& origin);
  Mission finish() &&;  ///< checks what several lines say together

 private:
  // One line each.
  void vertex(Fields& fields, std::string_view tag);
  void relative_edge(Fields& fields, std::string_view tag, int extra_fields);
  void pose_prior(Fields& fields);
  void position_prior(Fields& fields);
  void offset(Fields& fields);
  void platform(Fields& fields);
  void gnss_reference(Fields& fields);
  void gnss_transform(Fields& fields);
  void fix(Fields& fields);
  void unknown(std::string_view tag, std::string_view text, int line);
  void keep(std::string_view text, int line) {
    mission_.unknown_lines.push_back({line, std::string(text)});
  }
  void pose_and_information(Fields& fields, Edge& edge);
  void only_once(const Fields& fields, std::string_view tag, int& seen_line) const;

  // All lines together.
  void order_nodes();
  void merge_repeated(Node& first, const Node& second);
  void apply_offsets();
  void check_edges();
  void accept_backward_odometry();
  bool belongs_to_another_robot(const Edge& edge) const;
  void mark_fixed();
  void make_georeference();
  [[noreturn]] void fail(int line, const std::string& message) const;

  const std::filesystem::path& file_;
  Mission mission_;
  Warnings warnings_;
  std::vector<std::string_view> edge_text_;    // of mission_.edges
  std::map<std::int64_t, SE3> T_base_sensor_;  // PARAMS_SE3OFFSET
  std::vector<std::pair<NodeId, int>> fixed_;  // id, line
  GeoReference georeference_;
  std::string reference_text_, transform_text_;
  int platform_line_ = 0, reference_line_ = 0, transform_line_ = 0;
};

}  // namespace cambium
