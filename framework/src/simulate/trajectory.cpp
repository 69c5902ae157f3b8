// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/trajectory.hpp"

#include <algorithm>
#include <cmath>

#include "simulate/angles.hpp"
#include "simulate/random.hpp"

namespace cambium::simulate {
namespace {

using Vec2 = Eigen::Vector2d;

struct Step {
  Vec2 place;
  double yaw, travelled;
};

// Places at equal distances along the path.
std::vector<Step> steps_along(const std::vector<Vec2>& corners, double spacing) {
  std::vector<Step> out;
  double travelled = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec2 leg = corners[i] - corners[i - 1];
    const double length = leg.norm();
    const double yaw = std::atan2(leg.y(), leg.x());
    while (double(out.size()) * spacing <= travelled + length + 1e-9 && length > 0) {
      const double s = double(out.size()) * spacing;
      out.push_back({corners[i - 1] + (s - travelled) / length * leg, yaw, s});
    }
    travelled += length;
  }
  return out;
}

// Pushes a place out of what stands there at the height of the sensor. A few rounds: out of one
// stem may be into the next.
Vec2 clear_of(const std::vector<Stem>& obstacles, const Terrain& terrain, Vec2 place,
              double height) {
  constexpr double clearance = 0.5;  // of the sensor's axis from bark [m]
  for (int round = 0; round < 8; ++round) {
    bool moved = false;
    for (const Stem& s : obstacles) {
      // Most stand too far away to touch, whatever the ground: that is cheaper to see.
      const double reach = s.height * s.axis.head<2>().norm() + s.radius_at(0) + clearance;
      if ((place - s.base.head<2>()).squaredNorm() > reach * reach) continue;
      const double along = terrain.height(place.x(), place.y()) + height - s.base.z();
      if (along > s.height) continue;
      const Vec2 center = (s.base + std::max(0.0, along) * s.axis).head<2>();
      const Vec2 away = place - center;
      const double needed = s.radius_at(std::max(0.0, along)) + clearance;
      const double distance = away.norm();
      if (distance >= needed) continue;
      place = center + needed * (distance > 1e-6 ? Vec2(away / distance) : Vec2::UnitX());
      moved = true;
    }
    if (!moved) break;
  }
  return place;
}

/// Those that the path may touch: pushed from stem to stem it strays a few metres, and stems lean.
std::vector<Stem> beside(const std::vector<Step>& steps, const std::vector<Stem>& obstacles) {
  constexpr double strays = 30;  // [m]
  Vec2 low = Vec2::Constant(INFINITY), high = -low;
  for (const Step& s : steps) low = low.cwiseMin(s.place), high = high.cwiseMax(s.place);
  std::vector<Stem> out;
  for (const Stem& s : obstacles) {
    const Vec2 base = s.base.head<2>();
    const double reach = strays + s.height * s.axis.head<2>().norm();
    if (((low - base).cwiseMax(base - high).array() < reach).all()) out.push_back(s);
  }
  return out;
}

double mean_ground(const std::vector<Step>& steps, const Terrain& terrain) {
  double sum = 0;
  for (const Step& s : steps) sum += terrain.height(s.place.x(), s.place.y());
  return sum / double(std::max<std::size_t>(1, steps.size()));
}

}  // namespace

std::vector<TruePose> walk(const MissionSpec& mission, const Terrain& terrain,
                           const std::vector<Stem>& obstacles, std::uint64_t seed) {
  const PathSpec& path = mission.path;
  auto steps = steps_along(path_corners(path), path.spacing);
  if (mission.carried_at > 0)
    for (auto i = std::size_t(mission.carried_at); i < steps.size(); ++i)
      steps[i].place += Vec2(mission.carried_by[0], mission.carried_by[1]);
  const double level = mean_ground(steps, terrain), sway = radians(mission.sensor.sway);
  const Random stream(seed, "sway");
  const std::vector<Stem> near = beside(steps, obstacles);
  std::vector<TruePose> out;
  for (const Step& step : steps) {
    Random r = stream.fork(out.size());
    const Vec2 p = path.level ? step.place : clear_of(near, terrain, step.place, path.height);
    const double ground = path.level ? level : terrain.height(p.x(), p.y());
    const double roll = sway * r.normal(), pitch = sway * r.normal();
    const double yaw = step.yaw + sway * r.normal();
    out.push_back({{attitude(yaw, pitch, roll), Vec3(p.x(), p.y(), ground + path.height)},
                   (step.travelled + 0.1 * path.spacing * r.uniform()) / path.speed});
  }
  return out;
}

}  // namespace cambium::simulate
