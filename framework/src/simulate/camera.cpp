// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulate/angles.hpp"

namespace cambium::simulate {
namespace {

constexpr float sight = 60;  // beyond it all is bright haze [m]
constexpr double haze = 225;

/// -1..1, the same for every point of a cube of this edge [m].
double cube(const Eigen::Vector3f& p, float edge) {
  std::uint64_t h = std::uint64_t(std::lround(edge * 1000));
  for (int i = 0; i < 3; ++i) h = mix(h ^ std::uint64_t(std::int64_t(std::floor(p[i] / edge))));
  return double(h >> 11) * 0x1.0p-52 - 1.0;
}

/// Cubes that a pixel sees as less than two are left out: they would be noise of their own.
double texture(const Eigen::Vector3f& p, float pixel) {
  double sum = 0;
  for (const float edge : {0.05f, 0.12f, 0.35f, 1.1f})
    if (edge > 2 * pixel) sum += 28 * cube(p, edge);
  return sum;
}

double shade(Surface surface) {
  switch (surface) {
    case Surface::ground:
      return 95;
    case Surface::stem:
      return 120;
    case Surface::clutter:
      return 150;
    default:
      return haze;
  }
}

}  // namespace

Picture Camera::look(const Scene& scene, const SE3& T_world_base, const Random& stream) const {
  Picture out{spec_.columns, spec_.rows, {}};
  out.grey.reserve(std::size_t(out.columns) * std::size_t(out.rows));
  const Eigen::Matrix3f R_world_base = T_world_base.rotation().cast<float>();
  const Eigen::Vector3f origin = T_world_base.t.cast<float>();
  // Half the width of the picture at a distance of 1, over half of its columns.
  const float pixel =
      float(std::tan(radians(spec_.field_of_view) / 2)) / (0.5f * float(spec_.columns));
  for (int row = 0; row < out.rows; ++row)
    for (int column = 0; column < out.columns; ++column) {
      const Eigen::Vector3f d_base(1, pixel * (0.5f * float(out.columns - 1) - float(column)),
                                   pixel * (0.5f * float(out.rows - 1) - float(row)));
      const Eigen::Vector3f direction = (R_world_base * d_base).normalized();
      const Hit hit = scene.cast(origin, direction, sight, std::numeric_limits<float>::infinity());
      double value = haze;
      if (hit.surface != Surface::none) {
        const double near = 1 - double(hit.range / sight);  // haze grows with the distance
        value += near * (shade(hit.surface) - haze +
                         texture(origin + hit.range * direction, pixel * hit.range));
      }
      Random noise =
          stream.fork(std::uint64_t(row) * std::uint64_t(out.columns) + std::uint64_t(column));
      value += spec_.noise * noise.normal();
      out.grey.push_back(char(static_cast<unsigned char>(std::clamp(value, 0.0, 255.0))));
    }
  return out;
}

}  // namespace cambium::simulate
