// SPDX-License-Identifier: BSD-3-Clause
// A spinning lidar: `beams` elevations, `columns` directions in a turn. A scan is taken from one
// pose; that of a moving robot is thought of as undistorted already.
#pragma once
#include "simulate/random.hpp"
#include "simulate/scene.hpp"

namespace cambium::simulate {

class Lidar {
 public:
  explicit Lidar(const SensorSpec& spec);

  /// Points in the base frame. `stream` is that of the node: every ray draws from its own fork, so
  /// rays do not depend on one another.
  Cloud scan(const Scene& scene, const SE3& T_world_base, const Random& stream) const;

  std::size_t rays() const { return directions_.size(); }

 private:
  SensorSpec spec_;
  std::vector<Eigen::Vector3f> directions_;  ///< unit vectors in the base frame
};

}  // namespace cambium::simulate
