// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

// A number between 0 and 1 that depends on its arguments only (splitmix64, Steele et al. 2014):
// the distributions of the standard library differ between implementations.
double hash_unit(std::uint64_t seed, std::uint64_t a, std::uint64_t b = 0) {
  std::uint64_t z = seed * 0x9E3779B97F4A7C15u + a * 0xBF58476D1CE4E5B9u + b * 0x94D049BB133111EBu;
  for (int round = 0; round < 2; ++round) {
    z += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    z ^= z >> 31;
  }
  return double(z >> 11) * 0x1.0p-53;
}

constexpr double range = 30.0;     // [m]
constexpr double cell_size = 4.0;  // one stem in each cell of this width [m]

double ground_height(double x, double y, std::uint64_t seed) {
  const double a = 6.28 * hash_unit(seed, 1), b = 6.28 * hash_unit(seed, 2);
  return 0.8 * std::sin(0.11 * x + a) + 0.6 * std::cos(0.17 * y + b);
}

struct Stem {
  double x, y, radius, height;
};

Stem stem_in_cell(std::int64_t i, std::int64_t j, std::uint64_t seed) {
  const auto key = std::uint64_t(i + 1000000) * 4000000u + std::uint64_t(j + 1000000);
  return {(double(i) + hash_unit(seed, key, 1)) * cell_size,
          (double(j) + hash_unit(seed, key, 2)) * cell_size, 0.1 + 0.2 * hash_unit(seed, key, 3),
          4.0 + 8.0 * hash_unit(seed, key, 4)};
}

std::vector<Stem> stems_around(const Vec3& center, std::uint64_t seed) {
  const auto cell = [](double v) { return std::int64_t(std::floor(v / cell_size)); };
  std::vector<Stem> out;
  for (auto i = cell(center.x() - range); i <= cell(center.x() + range); ++i)
    for (auto j = cell(center.y() - range); j <= cell(center.y() + range); ++j) {
      const Stem stem = stem_in_cell(i, j, seed);
      if (std::hypot(stem.x - center.x(), stem.y - center.y()) < range) out.push_back(stem);
    }
  return out;
}

Vec3 ground_point(const Vec3& center, double u, double v, std::uint64_t seed) {
  const double r = range * std::sqrt(u), angle = 2 * M_PI * v;
  const double x = center.x() + r * std::cos(angle), y = center.y() + r * std::sin(angle);
  return {x, y, ground_height(x, y, seed)};
}

Vec3 stem_point(const Stem& stem, double u, double v, std::uint64_t seed) {
  const double angle = 2 * M_PI * u;
  return {stem.x + stem.radius * std::cos(angle), stem.y + stem.radius * std::sin(angle),
          ground_height(stem.x, stem.y, seed) + v * stem.height};
}

}  // namespace

Cloud forest_scan(const SE3& T_world_base, std::uint64_t seed, std::size_t points) {
  const auto stems = stems_around(T_world_base.t, seed);
  // Other samples of the same surfaces from every pose, as a real scanner takes them.
  Hasher pose;
  for (int k = 0; k < 3; ++k) pose.add(T_world_base.t[k]);
  const std::uint64_t sampling = pose.add(T_world_base.yaw()).add(seed).digest().low;
  const SE3 T_base_world = T_world_base.inverse();
  Cloud cloud;
  cloud.xyz.reserve(3 * points);
  for (std::size_t i = 0; i < points; ++i) {
    const double u = hash_unit(sampling, i, 1), v = hash_unit(sampling, i, 2);
    const auto& stem = stems[(i / 2) % stems.size()];
    const Vec3 p_world =
        i % 2 == 0 ? ground_point(T_world_base.t, u, v, seed) : stem_point(stem, u, v, seed);
    const Vec3 p_base = T_base_world * p_world;
    for (int k = 0; k < 3; ++k) cloud.xyz.push_back(float(p_base[k]));
  }
  return cloud;
}

}  // namespace cambium::testing
