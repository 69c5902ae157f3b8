// SPDX-License-Identifier: BSD-3-Clause
// Covariances of transforms. Everywhere in this plugin the covariance of T is that of xi in
// T_true = T exp(xi), xi = (translation; rotation) in the frame of T's source.
#pragma once
#include "cambium/se3.hpp"

namespace cambium::pcm {

/// Standard deviations of translation [m] and rotation [rad], the same on all axes.
struct Sigma {
  double translation = 0, rotation = 0;
};
Mat6 diagonal(const Sigma& sigma);

/// The covariance of T from the information of its residual (cambium/pose_graph.hpp), whose
/// translation is seen in the target's frame. Directions without information get a variance of 1e6.
Mat6 covariance_of(const SE3& T, const Mat6& information);

/// The covariance as seen through T: Ad(T) S Ad(T)'.
Mat6 through(const SE3& T, const Mat6& covariance);

}  // namespace cambium::pcm
