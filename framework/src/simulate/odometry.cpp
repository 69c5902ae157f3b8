// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/odometry.hpp"

#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {

// An error rate that walks with sigma sqrt(s) integrates to a standard deviation of
// sigma sqrt(L^3 / 3) after L. Yaw moves the end to the side, scale along: both are equal.
double walk_rate(const OdometrySpec& spec) {
  return spec.drift / 100 * std::sqrt(1.5 / spec.drift_length);
}

std::vector<SE3> believed_poses(const std::vector<TruePose>& truth, const OdometrySpec& spec,
                                int carried_at, std::uint64_t seed) {
  const double rate = walk_rate(spec), tilt = radians(spec.tilt);
  const Random stream(seed, "odometry");
  double yaw_error = 0, scale_error = 0;
  std::vector<SE3> out;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    Random r = stream.fork(i);
    const SE3& T_world_node = truth[i].T_world_base;
    Vec3 t = Vec3::Zero();
    if (i > 0) {
      const SE3& T_world_before = truth[i - 1].T_world_base;
      const bool seen = carried_at <= 0 || i != std::size_t(carried_at);
      const Vec3 motion = seen ? Vec3(T_world_node.t - T_world_before.t) : Vec3::Zero();
      // Rotated as the node before believes to be rotated: its tilt error lifts or sinks the path.
      const Quat q_mission_world = out.back().q * T_world_before.q.conjugate();
      t = out.back().t + (1 + scale_error) * (q_mission_world * motion);
      const double step = std::sqrt(motion.norm());
      yaw_error += rate * step * r.normal();
      scale_error += rate * step * r.normal();
      // The turn while it was carried is not seen either.
      if (!seen) yaw_error += T_world_before.yaw() - T_world_node.yaw();
    }
    const double heading = yaw_error - truth[0].T_world_base.yaw();
    const double about_x = tilt * r.normal(), about_y = tilt * r.normal();
    const Quat tilted = about(Vec3::UnitX(), about_x) * about(Vec3::UnitY(), about_y);
    out.push_back({(tilted * about(Vec3::UnitZ(), heading) * T_world_node.q).normalized(), t});
  }
  return out;
}

}  // namespace cambium::simulate
