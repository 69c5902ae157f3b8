// SPDX-License-Identifier: BSD-3-Clause
// Ground and canopy as a survey saw them, on a grid; and where its rays went.
#pragma once
#include <optional>
#include <vector>

#include "monitor/changes.hpp"

namespace cambium::monitor {

/// Layers of half a metre above a common level. More than 128 m up and down is not told apart.
constexpr int layers = 256;
constexpr double layer_height = 0.5;  // [m]

/// The rectangle of cells that two surveys may share, and its lowest level.
struct Grid {
  double cell_size = 1;
  Cell low{}, high{};  ///< first and last cell
  double level = 0;    ///< height of layer 0 [m]

  int columns() const { return high[0] - low[0] + 1; }
  std::size_t size() const { return std::size_t(columns()) * std::size_t(high[1] - low[1] + 1); }
  /// Nothing outside.
  std::optional<std::size_t> index(int x, int y) const {
    if (x < low[0] || x > high[0] || y < low[1] || y > high[1]) return std::nullopt;
    return std::size_t(y - low[1]) * std::size_t(columns()) + std::size_t(x - low[0]);
  }
  int layer(double z) const;
};

/// The rays of a survey: which layers of each cell they passed or hit, and the highest return.
/// Bits are set, never cleared: the order of nodes and threads does not matter.
class Rays {
 public:
  /// Of all clouds, moved by T; of a scan at most 20 000 rays, evenly taken.
  Rays(const Survey& survey, const SE3& T, const Grid& grid, const Context& context);

  /// The highest return of a cell, if there is one [m].
  std::optional<double> top(std::size_t cell) const;
  /// Whether a ray passed or hit this height of the cell, or half a metre beside.
  bool looked(std::size_t cell, double z) const;

 private:
  void trace(const Vec3& from, const Vec3& to);
  void pass(int x, int y, double z_a, double z_b);
  void raise(std::size_t cell, float z);

  const Grid& grid_;
  std::vector<std::uint64_t> looked_;  // layers / 64 words a cell
  std::vector<float> top_;             // -infinity: no return
};

/// Heights of the second survey above the first, cell by cell of the first one's map. Ground where
/// both have it. Canopy where the lower survey's rays passed the height that the higher one
/// reports.
std::vector<CellChange> compare_heights(const Survey& before, const Survey& after,
                                        const SE3& T_before_after, const GroundOptions& options,
                                        const Context& context);

}  // namespace cambium::monitor
