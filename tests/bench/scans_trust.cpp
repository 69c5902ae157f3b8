// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <cstdio>

#include "bench/registration_tally.hpp"
#include "bench/scans.hpp"
#include "simulate/angles.hpp"
#include "simulate/sensor.hpp"
#include "support/support.hpp"

namespace cambium::bench {
namespace {

using namespace simulate;
using testing::component;
using testing::make_context;

/// A simulated stand of its own for every seed.
struct Stand {
  explicit Stand(std::uint64_t seed) : terrain(make_terrain({}, spec().size, seed)) {
    const auto stems = plant(spec(), terrain, seed);
    scene = std::make_unique<Scene>(terrain, stems, scatter_clutter({}, spec(), terrain, seed),
                                    grow({}, spec(), terrain, stems, seed));
  }
  static StandSpec spec() {
    StandSpec stand;
    stand.size = {160, 160};
    return stand;
  }
  Scan scan(double x, double y, double yaw, std::int64_t item) const {
    SensorSpec sensor;
    sensor.beams = 32;
    const SE3 T_world_base{attitude(yaw, 0.03 * std::sin(3.0 * double(item)), 0.02),
                           Vec3(x, y, terrain.height(x, y) + 1.6)};
    Cloud cloud = Lidar(sensor).scan(*scene, T_world_base, Random(1, "scans", item));
    return {{std::make_shared<const Cloud>(std::move(cloud)), nullptr}, T_world_base};
  }
  Terrain terrain;
  std::unique_ptr<Scene> scene;
};

struct Strangers {
  int pairs = 0, accepted = 0;
  double overlap = 0, seen_through = 1;  ///< largest; smallest among those with enough overlap

  void add(const Registration& method, const PreparedScans& a, const PreparedScans& b) {
    for (const Prepared& target : a.prepared)
      for (const Prepared& source : b.prepared) {
        const Alignment found = method.align(target, source, SE3{}, *make_context());
        ++pairs;
        accepted += found.converged;
        if (found.scores.empty()) continue;
        overlap = std::max(overlap, found.scores[0].second);
        if (found.scores[0].second > 0.4)
          seen_through = std::min(seen_through, found.scores[3].second);
      }
  }
  void print(const char* name) const {
    std::printf("| %-34s | %6d | %3d | %.2f | %.2f |\n", name, pairs, accepted, overlap,
                seen_through);
    std::fflush(stdout);
  }
};

std::vector<Scan> every(std::size_t stride, std::vector<Scan> scans) {
  std::vector<Scan> out;
  for (std::size_t i = 0; i < scans.size(); i += stride) out.push_back(scans[i]);
  return out;
}

std::vector<Scan> walk(const Stand& stand, int scans) {
  std::vector<Scan> out;
  for (int i = 0; i < scans; ++i) out.push_back(stand.scan(-50 + 100.0 * i / scans, 8, 0.5 * i, i));
  return out;
}

}  // namespace

void stranger_table(const std::string& yaml, std::size_t stride) {
  const auto method = component<Registration>("global_registration", yaml);
  std::printf(
      "| places that never met | pairs | accepted | largest overlap | smallest seen_through where "
      "overlap > 0.4 |\n|---|---|---|---|---|\n");
  const PreparedScans campus = prepare(*method, every(stride, nclt()));
  for (const char* name : {"KAIST03", "Seosan01"}) {
    Strangers s;
    s.add(*method, prepare(*method, mulran(name)), campus);
    s.print((std::string(name) + " and nclt").c_str());
  }
  Strangers forest;
  const PreparedScans first = prepare(*method, walk(Stand(1), 20));
  for (const std::uint64_t seed : {2, 3, 4})
    forest.add(*method, first,
               prepare(*method, walk(Stand(seed), int(20 / std::min<std::size_t>(stride, 20)))));
  forest.print("simulated stands");
  std::printf("\n");
}

void honesty_table(const std::string& yaml, int pairs, std::uint64_t seed) {
  const auto method = component<Registration>("gicp", yaml);
  const Stand stand(seed);
  double sum = 0;
  Vec6 axes = Vec6::Zero();
  std::vector<double> translation;
  int used = 0;
  for (int i = 0; i < pairs; ++i) {
    const double angle = 2.4 * i, away = 8.0 * (i % 10) / 10;
    const double x = 60.0 * std::sqrt((i + 0.5) / pairs) * std::cos(angle),
                 y = 60.0 * std::sqrt((i + 0.5) / pairs) * std::sin(angle);
    const Scan a = stand.scan(x, y, 1.3 * i, 2 * i),
               b = stand.scan(x + away * std::sin(angle), y + away * std::cos(angle), 0.7 * i,
                              2 * i + 1);
    const SE3 truth = a.T_world_base.inverse() * b.T_world_base;
    Vec6 off;
    off << 0.2, -0.1, 0.1, 0.01, 0, 0.03;
    const auto context = make_context();
    const Alignment found =
        method->align(method->prepare(a.payload, *context), method->prepare(b.payload, *context),
                      truth * SE3::exp(off), *context);
    const SE3 error = found.T_target_source.inverse() * truth;
    if (error.t.norm() > 0.5) continue;  // another minimum, which no covariance speaks of
    Vec6 r;
    r << truth.t - found.T_target_source.t, 2 * error.q.vec() * (error.q.w() < 0 ? -1 : 1);
    sum += r.dot(found.information * r);
    axes += r.cwiseAbs2();
    translation.push_back(r.head<3>().norm());
    ++used;
  }
  const double band = 2.576 * std::sqrt(2 * 6.0 / used);
  std::printf(
      "gicp %s on %d of %d simulated pairs: NEES %.2f, 99 %% band %.2f to %.2f; median error %.4f "
      "m\n",
      yaml.c_str(), used, pairs, sum / used, 6 - band, 6 + band, median(translation));
  std::printf("rms per axis:");
  for (int k = 0; k < 6; ++k) std::printf(" %.5f", std::sqrt(axes[k] / used));
  std::printf("\n\n");
}

}  // namespace cambium::bench
