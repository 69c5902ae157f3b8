// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "monitor/heights.hpp"

namespace cambium::monitor {
namespace {

constexpr std::size_t words = layers / 64;
constexpr std::size_t rays_of_a_scan = 20000;
constexpr float nothing = -std::numeric_limits<float>::infinity();

}  // namespace

int Grid::layer(double z) const {
  return std::clamp(int(std::floor((z - level) / layer_height)), 0, layers - 1);
}

Rays::Rays(const Survey& survey, const SE3& T, const Grid& grid, const Context& context)
    : grid_(grid), looked_(grid.size() * words, 0), top_(grid.size(), nothing) {
  for (const std::uint32_t m : survey.missions) {
    const MissionView mission{survey.clouds, m};
    context.parallel_for(mission.size(), [&](std::size_t n) {
      context.check_cancelled();
      const auto cloud = mission.payload(n).cloud;
      if (!cloud) return;
      const SE3 T_map_node = T * mission.T_map_node(n);
      const std::size_t step = 1 + cloud->size() / rays_of_a_scan;
      for (std::size_t i = 0; i < cloud->size(); i += step) {
        const Vec3 p = T_map_node * Vec3(cloud->points().col(Eigen::Index(i)).cast<double>());
        if (p.allFinite()) trace(T_map_node.t, p);
      }
    });
  }
}

std::optional<double> Rays::top(std::size_t cell) const {
  return top_[cell] == nothing ? std::nullopt : std::optional<double>(top_[cell]);
}

bool Rays::looked(std::size_t cell, double z) const {
  const int middle = grid_.layer(z);
  for (int l = std::max(0, middle - 1); l <= std::min(layers - 1, middle + 1); ++l)
    if (looked_[cell * words + std::size_t(l) / 64] >> (l % 64) & 1) return true;
  return false;
}

/// From cell to cell, as Amanatides and Woo (1987) walk.
void Rays::trace(const Vec3& from, const Vec3& to) {
  const double size = grid_.cell_size;
  int cell[2], step[2];
  double next[2], width[2];
  const Vec3 way = to - from;
  for (int k = 0; k < 2; ++k) {
    cell[k] = int(std::floor(from[k] / size));
    step[k] = way[k] > 0 ? 1 : -1;
    const double edge = (cell[k] + (way[k] > 0 ? 1 : 0)) * size;
    next[k] = way[k] == 0 ? 2 : (edge - from[k]) / way[k];
    width[k] = way[k] == 0 ? 2 : size / std::abs(way[k]);
  }
  for (double s = 0; s < 1;) {
    const int k = next[0] < next[1] ? 0 : 1;
    const double end = std::min(1.0, next[k]);
    pass(cell[0], cell[1], from.z() + s * way.z(), from.z() + end * way.z());
    if (end >= 1) break;
    s = end;
    cell[k] += step[k];
    next[k] += width[k];
  }
  if (const auto last = grid_.index(int(std::floor(to.x() / size)), int(std::floor(to.y() / size))))
    raise(*last, float(to.z()));
}

void Rays::pass(int x, int y, double z_a, double z_b) {
  const auto cell = grid_.index(x, y);
  if (!cell) return;
  const int low = grid_.layer(std::min(z_a, z_b)), high = grid_.layer(std::max(z_a, z_b));
  for (int l = low; l <= high; ++l)
    std::atomic_ref(looked_[*cell * words + std::size_t(l) / 64])
        .fetch_or(std::uint64_t{1} << (l % 64), std::memory_order_relaxed);
}

void Rays::raise(std::size_t cell, float z) {
  std::atomic_ref<float> top(top_[cell]);
  float seen = top.load(std::memory_order_relaxed);
  while (z > seen && !top.compare_exchange_weak(seen, z, std::memory_order_relaxed)) {
  }
}

}  // namespace cambium::monitor
