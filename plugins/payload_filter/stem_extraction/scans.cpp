// SPDX-License-Identifier: BSD-3-Clause
#include "scans.hpp"

#include "common/neighbours.hpp"

namespace stem_extraction {
namespace {

using cambium::Cloud;
using cambium::SE3;

void append(const Cloud& cloud, const SE3& T_level_base, double range, Scans& scans) {
  const Eigen::Matrix3f R = T_level_base.rotation().cast<float>();
  const Eigen::Vector3f t = T_level_base.t.cast<float>();
  const auto view = std::uint16_t(scans.views.size());
  for (Eigen::Index i = 0; i < cloud.points().cols(); ++i) {
    const Eigen::Vector3f p = R * cloud.points().col(i) + t;
    // Written so that NaN fails.
    if (p.head<2>().cwiseAbs().maxCoeff() < float(range) && std::abs(p.z()) < 1e4f)
      scans.points.push_back({p, view});
  }
  scans.views.push_back({T_level_base.t.head<2>()});
}

}  // namespace

Scans join(const cambium::MissionView& mission, std::size_t node, const Cloud& cloud,
           const Join& join) {
  const auto& nodes = mission.mission().nodes;
  Scans out;
  for (const std::size_t i :
       cambium::filter::neighbours(mission.mission(), node, join.radius, join.spacing)) {
    const SE3 T_level_i{nodes[i].T_mission_node.q,
                        nodes[i].T_mission_node.t - nodes[node].T_mission_node.t};
    if (i == node) {
      out.own = out.views.size();
      append(cloud, T_level_i, join.range, out);
    } else if (const auto other = mission.payload(i).cloud) {
      append(*other, T_level_i, join.range, out);
    }
  }
  return out;
}

}  // namespace stem_extraction
