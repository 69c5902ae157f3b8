// SPDX-License-Identifier: BSD-3-Clause
// Points above the ground, in square columns, to look at those around a place.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "candidates.hpp"

namespace stem_extraction {

class Columns {
 public:
  /// Sorts the points, so that what is made of them does not depend on their order. They should
  /// lie within kilometres of the origin.
  explicit Columns(std::vector<Above> points);

  /// Calls visit(point) for the points at most `radius` away across, in a fixed order.
  template <class Visit>
  void visit(float x, float y, float radius, Visit visit) const {
    for (int iy = row(y - radius); iy <= row(y + radius); ++iy)
      for (int ix = row(x - radius); ix <= row(x + radius); ++ix)
        for (std::size_t i = begin_[index(ix, iy)]; i < begin_[index(ix, iy) + 1]; ++i) {
          const Above& p = points_[i];
          if (std::hypot(p.position.x() - x, p.position.y() - y) <= radius) visit(p);
        }
  }

 private:
  static constexpr float cell = 0.5f;  // [m]
  int row(float v) const { return std::clamp(int(std::floor((v + range_) / cell)), 0, width_ - 1); }
  std::size_t index(int ix, int iy) const {
    return std::size_t(iy) * std::size_t(width_) + std::size_t(ix);
  }

  std::vector<Above> points_;
  float range_ = 0;  ///< of the points, in x and y [m]
  int width_ = 1;
  std::vector<std::size_t> begin_;  ///< of each column in points_, and the end
};

}  // namespace stem_extraction
