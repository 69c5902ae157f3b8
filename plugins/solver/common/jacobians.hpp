// SPDX-License-Identifier: BSD-3-Clause
// Derivatives of cambium::residual by a step of a pose: (dt in the map frame; dtheta in the
// node's), t <- t + dt, q <- q exp(dtheta).
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "cambium/pose_graph.hpp"

namespace cambium::pose_solver {

inline Eigen::Matrix3d skew(const Eigen::Vector3d& v) {
  Eigen::Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

/// dr/d(tail) and dr/d(head). With dq = (w, v) the residual's rotation is 2 v, so r tells all.
struct Jacobians {
  using Block = Eigen::Matrix<double, 6, 6>;
  Block tail = Block::Zero(), head = Block::Zero();

  Jacobians(const SE3& T_tail_head, const Eigen::Matrix3d& R_tail_map, const Vec6& r) {
    const Eigen::Vector3d t = r.head<3>() + T_tail_head.t, v = 0.5 * r.tail<3>();
    const Eigen::Matrix3d w =
        std::sqrt(std::max(0.0, 1 - v.squaredNorm())) * Eigen::Matrix3d::Identity();
    tail.topLeftCorner<3, 3>() = -R_tail_map;
    tail.topRightCorner<3, 3>() = skew(t);
    tail.bottomRightCorner<3, 3>() = (skew(v) - w) * T_tail_head.rotation().transpose();
    head.topLeftCorner<3, 3>() = R_tail_map;
    head.bottomRightCorner<3, 3>() = w + skew(v);
  }
};

}  // namespace cambium::pose_solver
