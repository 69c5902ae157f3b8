// SPDX-License-Identifier: BSD-3-Clause
// Triangles of a reference mission by their shape.
#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "triangles.hpp"

namespace tree_match {

struct IndexLimits {
  double cell = 0.2;  ///< sides are hashed in cells of this width [m]
  bool probe = true;  ///< look into the nearer neighbour cell of every side, too: 8 cells
  double max_dbh_difference = 0.15;    ///< of each pair of stems [m]
  double max_height_difference = 0.6;  ///< of the bases, relative to vertex 0 [m]
};

/// Sorts the triangles into cells of chirality and the two shorter sides, within them by the
/// longest side: the cells of the third side are runs of neighbours in memory.
class TriangleIndex {
 public:
  TriangleIndex(std::vector<Triangle> triangles, const IndexLimits& limits);

  std::size_t size() const { return triangles_.size(); }

  /// Calls visit(reference triangle) for every hit whose stems were last seen before node `end`.
  template <class Visit>
  void hits(const Triangle& query, std::uint32_t end, Visit visit) const {
    const Range a = cells(query.side[0]), b = cells(query.side[1]), c = cells(query.side[2]);
    for (int i = a.low; i < a.high; ++i)
      for (int j = std::max(b.low, i); j < b.high; ++j) {
        if (j >= rows_) break;
        const std::size_t row = row_of(query.clockwise, i, j);
        const auto last = triangles_.begin() + begin_[row + 1];
        auto it =
            std::lower_bound(triangles_.begin() + begin_[row], last, c.low * cell_,
                             [](const Triangle& t, int side) { return int(t.side[2]) < side; });
        for (; it != last && int(it->side[2]) < c.high * cell_; ++it)
          if (it->last < end && compatible(query, *it)) visit(*it);
      }
  }

 private:
  struct Range {
    int low, high;  ///< cells low..high-1
  };
  Range cells(int side) const {
    const int cell = side / cell_;
    if (!probe_) return {cell, cell + 1};
    return 2 * (side % cell_) < cell_ ? Range{std::max(0, cell - 1), cell + 1}
                                      : Range{cell, cell + 2};
  }
  std::size_t row_of(std::uint8_t clockwise, int a, int b) const {
    return (std::size_t(clockwise) * std::size_t(rows_) + std::size_t(a)) * std::size_t(rows_) +
           std::size_t(b);
  }
  bool compatible(const Triangle& a, const Triangle& b) const {
    for (std::size_t v = 0; v < 2; ++v)
      if (a.dz[v] != Triangle::unknown_dz && b.dz[v] != Triangle::unknown_dz &&
          std::abs(int(a.dz[v]) - int(b.dz[v])) > max_dz_)
        return false;
    for (std::size_t v = 0; v < 3; ++v)
      if (a.dbh[v] && b.dbh[v] && std::abs(int(a.dbh[v]) - int(b.dbh[v])) > max_dbh_) return false;
    return true;
  }

  int cell_;  // [mm]
  bool probe_;
  int max_dbh_, max_dz_;  // in the units of Triangle
  int rows_ = 0;          // cells of a side
  std::vector<Triangle> triangles_;
  std::vector<std::ptrdiff_t> begin_;  // of each row in triangles_, and their end
};

}  // namespace tree_match
