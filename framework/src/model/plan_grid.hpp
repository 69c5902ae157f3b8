// SPDX-License-Identifier: BSD-3-Clause
// Places by square cells as wide as the radius of the searches: what is near lies in nine cells.
#pragma once
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "cambium/se3.hpp"

namespace cambium {

class PlanGrid {
 public:
  explicit PlanGrid(double radius) : radius_(radius) {}

  void insert(const Vec3& p, std::size_t index) { cells_[cell(p)].push_back({p, index}); }

  /// Calls visit(index, distance on the plan) for every place nearer than the radius.
  template <class Visit>
  void within(const Vec3& p, Visit visit) const {
    const auto [x, y] = cell(p);
    for (long i = x - 1; i <= x + 1; ++i)
      for (long j = y - 1; j <= y + 1; ++j) {
        const auto it = cells_.find({i, j});
        if (it == cells_.end()) continue;
        for (const auto& [q, index] : it->second) {
          const double distance = std::hypot(p.x() - q.x(), p.y() - q.y());
          if (distance < radius_) visit(index, distance);
        }
      }
  }

  /// The nearest place, the one of the lowest index of equals.
  std::optional<std::size_t> nearest(const Vec3& p) const {
    std::optional<std::pair<double, std::size_t>> best;
    within(p, [&](std::size_t index, double distance) {
      const std::pair found{distance, index};
      if (!best || found < *best) best = found;
    });
    return best ? std::optional(best->second) : std::nullopt;
  }

 private:
  std::pair<long, long> cell(const Vec3& p) const {
    return {long(std::floor(p.x() / radius_)), long(std::floor(p.y() / radius_))};
  }

  double radius_;
  std::map<std::pair<long, long>, std::vector<std::pair<Vec3, std::size_t>>> cells_;
};

}  // namespace cambium
