// SPDX-License-Identifier: BSD-3-Clause
#include "level.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <array>

namespace cambium::registration {

Eigen::Vector3f vertical(const Patches& patches) {
  // Each pass takes the surfaces that are level or upright to within this much, in degrees.
  constexpr std::array within = {20.0, 15.0, 12.0, 10.0, 8.0, 8.0};
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  for (const double degrees : within) {
    const double sine = std::sin(degrees * M_PI / 180), cosine = std::cos(degrees * M_PI / 180);
    // Minimise the sum of (n'up)^2 over upright ones less that over level ones.
    Eigen::Matrix3d form = Eigen::Matrix3d::Zero();
    for (const Patch& p : patches) {
      const Eigen::Vector3d n = p.normal.cast<double>();
      const double along = std::abs(n.dot(up));
      if (along > cosine) form -= n * n.transpose();
      if (along < sine) form += n * n.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(form);
    const Eigen::Vector3d axis = axes.eigenvectors().col(0);
    const Eigen::Vector3d next = axis.z() < 0 ? Eigen::Vector3d(-axis) : axis;
    // A cloud of one wall has no say: stay at the base frame's own axis.
    if (!next.allFinite() || next.z() < std::cos(25 * M_PI / 180)) return Eigen::Vector3f::UnitZ();
    up = next;
  }
  return up.cast<float>();
}

Eigen::Matrix3f levelling(const Eigen::Vector3f& up) {
  return Eigen::Quaternionf::FromTwoVectors(up, Eigen::Vector3f::UnitZ()).toRotationMatrix();
}

}  // namespace cambium::registration
