// SPDX-License-Identifier: BSD-3-Clause
#include "common/levelled.hpp"

#include <algorithm>

namespace columns {

cambium::Quat level_rotation(const cambium::SE3& T_mission_node) {
  const Eigen::Vector3d up_base = T_mission_node.q.conjugate() * cambium::Vec3::UnitZ();
  return cambium::Quat::FromTwoVectors(up_base, Eigen::Vector3d::UnitZ());
}

cambium::Cloud::Matrix3X levelled(const cambium::Cloud& cloud, const cambium::Quat& q_level_base) {
  const Eigen::Matrix3f R_level_base = q_level_base.toRotationMatrix().cast<float>();
  const auto points = cloud.points();
  cambium::Cloud::Matrix3X out(3, points.cols());
  Eigen::Index n = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (points.col(i).allFinite()) out.col(n++).noalias() = R_level_base * points.col(i);
  out.conservativeResize(Eigen::NoChange, n);
  return out;
}

void write_rotation(const cambium::Quat& q_level_base, std::span<float> to) {
  for (std::size_t i = 0; i < rotation_size; ++i) to[i] = float(q_level_base.coeffs()[long(i)]);
}

cambium::SE3 T_level_base(std::span<const float> q) {
  return {cambium::Quat(q[3], q[0], q[1], q[2]).normalized(), cambium::Vec3::Zero()};
}

cambium::Cloud::Matrix3X upright_points(const cambium::MissionView& mission, std::size_t node,
                                        bool level, std::span<float> rotation) {
  cambium::Quat q_level_base = cambium::Quat::Identity();
  if (level) q_level_base = level_rotation(mission.mission().nodes[node].T_mission_node);
  write_rotation(q_level_base, rotation);
  const cambium::Payload payload = mission.payload(node);
  if (!payload.cloud) return cambium::Cloud::Matrix3X(3, 0);
  return levelled(*payload.cloud, q_level_base);
}

}  // namespace columns
