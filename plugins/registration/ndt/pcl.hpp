// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "cambium/se3.hpp"

namespace cambium::registration {

/// PCL reports ordinary outcomes ("not enough correspondences") on the console; a library must not
/// print. For the whole process; call it when the plugin is opened.
void silence_pcl();

inline SE3 to_se3(const Eigen::Matrix4f& T) { return SE3::from_matrix(T.cast<double>()); }
inline Eigen::Matrix4f to_matrix(const SE3& T) { return T.matrix().cast<float>(); }

}  // namespace cambium::registration
