// SPDX-License-Identifier: BSD-3-Clause
// The ground as some missions saw it, in cells of the map.
#pragma once
#include <array>
#include <map>
#include <optional>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"

namespace cambium {

using Cell = std::array<int, 2>;  ///< x and y, whole cells of the map frame

struct GroundOptions {
  double cell_size = 1;    ///< [m]
  double max_range = 15;   ///< of a point from its node, horizontally [m]
  double thickness = 0.2;  ///< points so close above the lowest of a cell are ground [m]
  int min_points = 10;     ///< of a scan in a cell
};

/// One point of the ground in each cell. The points of one scan in a cell give their mean over the
/// lowest layer; of several scans the one of median height stands, so that a scan which saw a stem
/// but not the ground behind it does not count.
class Ground {
 public:
  /// The missions must share a map frame.
  Ground(const Atlas& atlas, const std::vector<std::uint32_t>& missions,
         const GroundOptions& options, const Context& context);

  const std::map<Cell, Vec3>& cells() const { return cells_; }
  /// Height above a place of cell `c`, on the plane through the cells around it; nothing when fewer
  /// than four of these nine are known, or when they lie in a line.
  std::optional<double> height(const Cell& c, double x, double y) const;

 private:
  double cell_size_;  // [m]
  std::map<Cell, Vec3> cells_;
};

}  // namespace cambium
