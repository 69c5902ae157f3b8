// SPDX-License-Identifier: BSD-3-Clause
// What ties frames together in a g2o file: the mounting of sensors, the place on the globe.
#include "cambium/dialect.hpp"
#include "io/g2o_parser.hpp"

namespace cambium {

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

}  // namespace cambium
