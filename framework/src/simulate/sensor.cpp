// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/sensor.hpp"

#include <cmath>

#include "simulate/angles.hpp"

namespace cambium::simulate {

Lidar::Lidar(const SensorSpec& spec) : spec_(spec) {
  const Quat q_base_lidar = about(Vec3::UnitY(), radians(spec.mount_pitch));
  const double step = spec.beams > 1 ? (spec.highest - spec.lowest) / (spec.beams - 1) : 0;
  for (int column = 0; column < spec.columns; ++column)
    for (int beam = 0; beam < spec.beams; ++beam) {
      const double azimuth = radians(360.0 * column / spec.columns);
      const double elevation = radians(spec.lowest + step * beam);
      const Vec3 d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                   std::sin(elevation));
      directions_.push_back((q_base_lidar * d).cast<float>());
    }
}

namespace {

/// The codes of docs/formats.md.
std::uint8_t label_of(Surface surface) {
  switch (surface) {
    case Surface::ground: return 2;
    case Surface::stem: return 64;
    case Surface::clutter: return 65;
    case Surface::foliage: return 66;
    case Surface::none: break;
  }
  return 0;
}

}  // namespace

Cloud Lidar::scan(const Scene& scene, const SE3& T_world_base, const Random& stream) const {
  const Eigen::Matrix3f R_world_base = T_world_base.rotation().cast<float>();
  const Eigen::Vector3f origin = T_world_base.t.cast<float>();
  Cloud cloud;
  for (std::size_t ray = 0; ray < directions_.size(); ++ray) {
    Random random = stream.fork(ray);
    const Eigen::Vector3f direction = R_world_base * directions_[ray];
    const float optical_depth = -std::log(1.0f - float(random.next() >> 40) * 0x1.0p-24f);
    const Hit hit = scene.cast(origin, direction, float(spec_.max_range), optical_depth);
    if (hit.surface == Surface::none || hit.range < float(spec_.min_range)) continue;
    const float range = hit.range + float(spec_.range_noise * random.normal());
    const Eigen::Vector3f p_base = range * directions_[ray];
    cloud.xyz.insert(cloud.xyz.end(), p_base.data(), p_base.data() + 3);
    if (spec_.labels) cloud.label.push_back(label_of(hit.surface));
  }
  return cloud;
}

}  // namespace cambium::simulate
