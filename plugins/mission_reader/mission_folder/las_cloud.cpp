// SPDX-License-Identifier: BSD-3-Clause
#include "las_cloud.hpp"

#include <cmath>

#include "cloud_header.hpp"
#include "common/las_points.hpp"

namespace cambium {

LoadedCloud load_las(const std::filesystem::path& path) {
  constexpr double farthest = 1e5;  // where a float's step is 8 mm [m]
  const las::Header header = las::read_header(path);
  LoadedCloud out;
  out.cloud.xyz.reserve(3 * header.points);
  out.cloud.intensity.reserve(header.points);
  out.cloud.label.reserve(header.points);
  bool labelled = false;
  las::for_each_point(path, header, [&](const las::Point& p) {
    for (const double value : {p.x, p.y, p.z}) {
      if (!(std::abs(value) < farthest))
        refuse(path, "has a point at " + std::to_string(value) +
                         " m; a mission's cloud is in the base frame of its node, within 100 km. "
                         "The reader las_tiles reads files in the coordinates of a country");
      out.cloud.xyz.push_back(float(value));
    }
    out.cloud.intensity.push_back(float(p.intensity));
    out.cloud.label.push_back(p.classification);
    labelled = labelled || p.classification != 0;
  });
  if (!labelled) out.cloud.label = {};
  return out;
}

}  // namespace cambium
