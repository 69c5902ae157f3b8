// SPDX-License-Identifier: BSD-3-Clause
#include "pair_cloud.hpp"

#include <cmath>
#include <cstdint>
#include <vector>

#include "point.hpp"

namespace web_view {

std::string pair_cloud(const cambium::Cloud& cloud, std::size_t most) {
  std::vector<std::int16_t> out;
  // Every k-th point of a scan would show the sensor's pattern.
  const std::size_t size = cloud.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (mixed(i) % size >= most) continue;
    const Eigen::Vector3f cm = 100 * cloud.points().col(Eigen::Index(i));
    if (!(cm.cwiseAbs().maxCoeff() < 32767 && cm.allFinite())) continue;
    for (const float v : cm) out.push_back(std::int16_t(std::lround(v)));
  }
  return {reinterpret_cast<const char*>(out.data()), out.size() * sizeof(std::int16_t)};
}

}  // namespace web_view
