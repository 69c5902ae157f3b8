// SPDX-License-Identifier: BSD-3-Clause
// How fast lidar scans are simulated: bench_simulate [scans]. One thread, scans of 64 x 1024 rays
// in the default stand (940 stems/ha, foliage, clutter, terrain), from another place each.
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "simulate/angles.hpp"
#include "simulate/sensor.hpp"

namespace {

using namespace cambium;
using namespace cambium::simulate;

struct Rate {
  double seconds = 0;  ///< of one processor
  std::size_t points = 0;
};

Rate run(const SensorSpec& sensor, const Scene& scene, const Terrain& terrain, double height,
         int scans) {
  const Lidar lidar(sensor);
  Rate out;
  const std::clock_t start = std::clock();  // processor time: other work does not count
  for (int i = 0; i < scans; ++i) {
    const double angle = 2.4 * i, radius = 50 * std::sqrt((i + 0.5) / scans);  // evenly spread
    const double x = radius * std::cos(angle), y = radius * std::sin(angle);
    const SE3 T_world_base{attitude(angle, 0.02, -0.02), Vec3(x, y, terrain.height(x, y) + height)};
    out.points += lidar.scan(scene, T_world_base, Random(1, "bench", i)).size();
  }
  out.seconds = double(std::clock() - start) / CLOCKS_PER_SEC;
  return out;
}

void row(const char* name, const SensorSpec& sensor, const Scene& scene, const Terrain& terrain,
         double height, int scans) {
  const Rate r = run(sensor, scene, terrain, height, scans);
  const double rays = double(scans) * sensor.beams * sensor.columns;
  std::printf("%-16s %6d %10zu %8.2f %10.2f %8.0f %14.1f\n", name, scans, r.points / scans,
              r.seconds, 1e-6 * rays / r.seconds, 1e9 * r.seconds / rays, 1000 * r.seconds / scans);
}

}  // namespace

int main(int argc, char** argv) {
  const int scans = argc > 1 ? std::atoi(argv[1]) : 100;
  StandSpec stand;
  stand.size = {220, 220};
  const Terrain terrain = make_terrain({}, stand.size, 1);
  const auto stems = plant(stand, terrain, 1);
  const auto clutter = scatter_clutter({}, stand, terrain, 1);
  const Scene full(terrain, stems, clutter, grow({}, stand, terrain, stems, 1));
  FoliageSpec none;
  none.extinction = none.understory = 0;
  const Scene bare(terrain, stems, clutter, grow(none, stand, terrain, stems, 1));
  SensorSpec sensor;
  sensor.beams = 64;
  std::printf("%-16s %6s %10s %8s %10s %8s %14s\n", "64 x 1024 rays", "scans", "points", "s",
              "Mrays/s", "ns/ray", "s/1000 scans");
  row("stand", sensor, full, terrain, 1.6, scans);
  row("without foliage", sensor, bare, terrain, 1.6, scans);
  sensor.mount_pitch = 90, sensor.max_range = 120;
  row("UAV at 60 m", sensor, full, terrain, 60, scans);
  return 0;
}
