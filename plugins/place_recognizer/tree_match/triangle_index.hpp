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
  double max_side_difference = 0.15;   ///< of each pair of sides [m]
  double max_dbh_difference = 0.15;    ///< of each pair of stems [m]
  double max_height_difference = 0.6;  ///< of the bases, relative to vertex 0 [m]
};

/// Sorts the triangles into rows of chirality and the cells of the two shorter sides, within them
/// by the longest side. What decides about a hit lies in lanes of bytes, so that the compiler
/// tests 16 triangles at once: of a hundred thousands of similar ones a tenth are hits.
class TriangleIndex {
 public:
  TriangleIndex(std::vector<Triangle> triangles, const IndexLimits& limits);

  std::size_t size() const { return triangles_.size(); }
  /// Into the order of this index. Equal triangles keep the order of their stems.
  void sort(std::vector<Triangle>& triangles) const;

  /// Calls visit(reference triangle) for every hit whose stems were last seen before node `end`.
  template <class Visit>
  void hits(const Triangle& query, std::uint32_t end, Visit visit) const {
    const Range a = cells(query.side[0]), b = cells(query.side[1]);
    for (int i = a.low; i < a.high; ++i)
      for (int j = std::max(b.low, i); j < std::min(b.high, rows_); ++j) {
        const Gates gates = gates_of(query, i, j);
        const Run run = run_of(query, i, j);
        for (std::size_t k = run.first; k < run.last; k += block) {
          const std::size_t count = std::min(block, run.last - k);
          std::array<std::uint8_t, block> passes;
          test(gates, k, count, passes.data());
          for (std::size_t n = 0; n < count; ++n)
            if (passes[n] && triangles_[k + n].last < end) visit(triangles_[k + n]);
        }
      }
  }

 private:
  static constexpr std::size_t block = 256, lanes = 7;  // two sides, three diameters, two heights

  struct Range {
    int low, high;  ///< cells low..high-1
  };
  struct Run {
    std::size_t first, last;  ///< triangles first..last-1
  };
  /// Passes values low..low+span, and 0: not known.
  struct Gate {
    std::uint8_t low = 0, span = 255;
  };
  using Gates = std::array<Gate, lanes>;

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
  std::size_t row_of(const Triangle& t) const {
    return row_of(t.clockwise, t.side[0] / cell_, t.side[1] / cell_);
  }
  Gates gates_of(const Triangle& query, int a, int b) const;
  Run run_of(const Triangle& query, int a, int b) const;
  void test(const Gates& gates, std::size_t first, std::size_t count, std::uint8_t* passes) const;
  std::uint8_t offset_in_cell(int side, int cell) const;

  int cell_, max_side_;  // [mm]
  bool probe_;
  int max_dbh_, max_dz_;  // in the units of Triangle
  int rows_ = 0;          // cells of a side
  std::vector<Triangle> triangles_;
  std::vector<std::uint16_t> longest_;  // side of each triangle
  std::array<std::vector<std::uint8_t>, lanes> lane_;
  std::vector<std::size_t> begin_;  // of each row in triangles_, and their end
};

}  // namespace tree_match
