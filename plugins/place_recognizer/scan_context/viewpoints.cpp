// SPDX-License-Identifier: BSD-3-Clause
#include "viewpoints.hpp"

#include <algorithm>
#include <cmath>

namespace scan_context {

std::vector<Eigen::Vector2f> viewpoints(double radius, double step) {
  std::vector<Eigen::Vector2f> out;
  const int n = int(radius / step);
  for (int x = -n; x <= n; ++x)
    for (int y = -n; y <= n; ++y)
      if (std::hypot(x, y) * step <= radius) out.emplace_back(float(x * step), float(y * step));
  std::stable_sort(out.begin(), out.end(), [](const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
    return a.squaredNorm() < b.squaredNorm();
  });
  return out;
}

}  // namespace scan_context
