// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <numbers>

#include "cambium/se3.hpp"

namespace cambium::simulate {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

inline Quat about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis)); }

/// R_world_base = Rz(yaw) Ry(pitch) Rx(roll) [rad]
inline Quat attitude(double yaw, double pitch, double roll) {
  return about(Vec3::UnitZ(), yaw) * about(Vec3::UnitY(), pitch) * about(Vec3::UnitX(), roll);
}

/// The unit vector that leans from the vertical by rotations about x and y [rad].
inline Vec3 leaning(double about_x, double about_y) {
  return Vec3(std::tan(about_y), -std::tan(about_x), 1).normalized();
}

}  // namespace cambium::simulate
