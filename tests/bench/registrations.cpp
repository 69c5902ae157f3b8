// SPDX-License-Identifier: BSD-3-Clause
// How often and how fast registrations succeed on real scans:
//   bench_registrations gicp ["{hypotheses: 1}"]
// Built with -DCAMBIUM_BUILD_BENCH=ON; see docs/benchmarks.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

#include "bench/registration_data.hpp"
#include "bench/registration_tally.hpp"
#include "support/support.hpp"

namespace {

using namespace cambium;
using bench::cpu_milliseconds;
using bench::degree;
using bench::Scan;
using bench::Tally;

struct PreparedScans {
  std::vector<Prepared> clouds;
  double milliseconds = 0;  ///< median
};

PreparedScans prepare(const Registration& method, const std::vector<Scan>& scans) {
  PreparedScans out;
  std::vector<double> times;
  for (const Scan& scan : scans) {
    const double start = cpu_milliseconds();
    out.clouds.push_back(method.prepare(scan.payload, *cambium::testing::make_context()));
    times.push_back(cpu_milliseconds() - start);
  }
  out.milliseconds = median(times);
  return out;
}

/// Where the registration starts from; uniform in -1..1 by `random`, which is the same everywhere.
struct Start {
  const char* name;
  double yaw_error;   ///< [rad]; with it only the yaw is known
  double yaw_offset;  ///< [rad] a wrong yaw on purpose
};
constexpr std::array starts{Start{"near (1 m, 5 deg)", 0, 0},
                            Start{"yaw only (+-3 deg)", 3 * degree, 0},
                            Start{"wrong yaw (90 or 180 deg)", 20 * degree, M_PI / 2}};

double uniform(std::mt19937_64& random) { return double(random() >> 11) * 0x1.0p-52 - 1; }

SE3 guess_for(const Start& start, const SE3& truth, std::mt19937_64& random) {
  const auto direction = [&] {
    Vec3 v(uniform(random), uniform(random), uniform(random));
    return Vec3(v.normalized());
  };
  if (start.yaw_error == 0) {
    Vec6 error;
    error << direction(), 5 * degree * direction();
    return truth * SE3::exp(error);
  }
  const double wrong = start.yaw_offset * (random() % 2 ? 1 : 2);
  return SE3::from_yaw(truth.yaw() + wrong + start.yaw_error * uniform(random));
}

void between_missions(const Registration& method, const Start& start) {
  const std::vector<Scan> a = bench::newer_college("mission_a"),
                          b = bench::newer_college("mission_b");
  const PreparedScans pa = prepare(method, a), pb = prepare(method, b);
  constexpr std::array limits{2.0, 5.0, 10.0, 15.0};
  std::array<Tally, limits.size()> tallies;
  std::mt19937_64 random(7);
  const auto context = cambium::testing::make_context();
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < b.size(); ++j) {
      const SE3 truth = a[i].T_world_base.inverse() * b[j].T_world_base;
      const auto bin = std::lower_bound(limits.begin(), limits.end(), truth.t.norm());
      if (bin == limits.end()) continue;
      const SE3 guess = guess_for(start, truth, random);
      const double begin = cpu_milliseconds();
      const Alignment found = method.align(pa.clouds[i], pb.clouds[j], guess, *context);
      tallies[std::size_t(bin - limits.begin())].add(found, truth, cpu_milliseconds() - begin);
    }
  double from = 0;
  for (std::size_t k = 0; k < limits.size(); from = limits[k++])
    tallies[k].print(std::string(start.name) + ", " + std::to_string(int(from)) + "-" +
                     std::to_string(int(limits[k])) + " m");
}

/// Scans `step` apart along one path, from the identity.
void along_path(const Registration& method, const std::string& name, const std::vector<Scan>& scans,
                std::size_t step) {
  const PreparedScans prepared = prepare(method, scans);
  Tally tally;
  const auto context = cambium::testing::make_context();
  for (std::size_t i = 0; i + step < scans.size(); i += step) {
    const SE3 truth = scans[i].T_world_base.inverse() * scans[i + step].T_world_base;
    const double begin = cpu_milliseconds();
    const Alignment found =
        method.align(prepared.clouds[i], prepared.clouds[i + step], SE3{}, *context);
    tally.add(found, truth, cpu_milliseconds() - begin);
  }
  tally.print(name + ", " + std::to_string(step) + " apart");
  if (!scans.empty())
    std::printf("prepare(): %.0f ms a scan of %s\n", prepared.milliseconds, name.c_str());
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) return std::fprintf(stderr, "usage: %s PLUGIN [YAML]\n", argv[0]), 2;
  const auto method = cambium::testing::component<Registration>(argv[1], argc > 2 ? argv[2] : "{}");
  std::printf("%s %s\n", argv[1], argc > 2 ? argv[2] : "");
  Tally::print_header();
  for (const Start& start : starts) between_missions(*method, start);
  for (const char* sequence : {"KAIST03", "Seosan01"})
    along_path(*method, sequence, bench::mulran(sequence), 1);
  return 0;
} catch (const std::exception& e) {
  return std::fprintf(stderr, "%s\n", e.what()), 1;
}
