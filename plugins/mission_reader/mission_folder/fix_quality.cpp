// SPDX-License-Identifier: BSD-3-Clause
#include "fix_quality.hpp"

#include <algorithm>

namespace cambium {

Mat3 covariance_of_quality(int quality, double hdop) {
  static constexpr double sigma[] = {0, 3, 1, 3, 0.02, 0.3, 20};  // [m] at a dilution of 1
  const double horizontal = sigma[quality] * std::max(hdop, 0.5);
  return Vec3(horizontal, horizontal, 2 * horizontal).cwiseAbs2().asDiagonal();
}

}  // namespace cambium
