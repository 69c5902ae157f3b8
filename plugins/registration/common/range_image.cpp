// SPDX-License-Identifier: BSD-3-Clause
#include "common/range_image.hpp"

#include <algorithm>
#include <cmath>

namespace cambium::registration {

std::size_t RangeImage::square(const Eigen::Vector3f& direction) {
  int axis = 0;
  const float longest = direction.cwiseAbs().maxCoeff(&axis);
  const auto cell = [&](int k) {
    const float u = 0.5F + 0.5F * direction[k % 3] / longest;
    return std::clamp(int(u * float(width)), 0, width - 1);
  };
  const int face = 2 * axis + (direction[axis] < 0 ? 1 : 0);
  return std::size_t((face * width + cell(axis + 1)) * width + cell(axis + 2));
}

RangeImage::RangeImage(const Cloud& cloud) : ranges_(6 * width * width, 0.0F) {
  constexpr float mount = 0.5F;  // [m] what is nearer carries the sensor
  const auto points = cloud.points();
  for (Eigen::Index i = 0; i < points.cols(); ++i) {
    const Eigen::Vector3f p = points.col(i);
    const float range = p.norm();
    if (!(range > mount && range < 1e6F)) continue;  // written so that NaN fails
    float& nearest = ranges_[square(p)];
    if (nearest == 0 || range < nearest) nearest = range;
  }
}

Sight look(const RangeImage& target, const Patches& source, const SE3& T_target_source) {
  const Eigen::Matrix3f R = T_target_source.rotation().cast<float>();
  const Eigen::Vector3f t = T_target_source.t.cast<float>();
  Sight sight;
  for (const Patch& patch : source) {
    if (!(patch.normal.head<2>().norm() > 0.7F)) continue;
    const Eigen::Vector3f p = R * patch.at + t;
    const float range = p.norm();
    if (!(range > 1)) continue;
    const float seen = target.range(p);
    const float margin = 1 + 0.03F * range;  // a turn by 2 degrees, and the width of a square
    if (seen == 0 || range > seen + margin) continue;
    ++(range < seen - margin ? sight.seen_through : sight.confirmed);
  }
  return sight;
}

}  // namespace cambium::registration
