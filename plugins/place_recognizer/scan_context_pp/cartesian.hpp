// SPDX-License-Identifier: BSD-3-Clause
// The cartesian context of one cloud: the highest point in every bin of a rectangular grid whose x
// axis is the heading of the base. G. Kim, S. Choi, A. Kim, "Scan Context++: Structural Place
// Recognition Robust to Rotation and Lateral Variations in Urban Environments", IEEE T-RO 2022.
//
// Its columns are the lanes beside each other, so that a passage to the side is a shift of columns
// like a turn is of the polar context. Behind the lanes lie as many empty columns: what is shifted
// out on one side does not come back on the other.
#pragma once
#include <span>
#include <vector>

#include "cambium/payload.hpp"
#include "common/shape.hpp"

namespace scan_context_pp {

struct CartesianGrid {
  double length = 40.0, width = 40.0;  ///< half of the extent, ahead and to the side [m]
  double bin = 2.0;                    ///< edge of a bin [m]
  int steps = 1;                       ///< bins that a view may stand ahead or behind
  int headings = 1;                    ///< that a view may have to the left and to the right
  double heading_step = 0.14;          ///< between them [rad]

  int lanes() const;     ///< across
  int stations() const;  ///< along, as a view sees them
  columns::Shape shape() const { return {stations(), 2 * lanes()}; }
  /// Of all bins that views of one heading see: lane by lane, stations() + 2 steps in each.
  std::size_t height_count() const;
  /// For each heading in turn: straight on, left, right, farther left, ... [rad]
  std::vector<double> all_headings() const;
};

/// The base as another robot might have passed it: turned a little, then some bins ahead, and
/// perhaps the other way.
struct CartesianView {
  std::size_t heading = 0;  ///< in all_headings()
  int ahead = 0;
  bool reversed = false;
};

/// The base itself first.
std::vector<CartesianView> cartesian_views(const CartesianGrid& grid);

/// Writes the highest of levelled points in each bin, `height_offset` added, 0 where there is none
/// or it lies lower than that. The grid is turned by `heading` [rad]. `heights` has height_count()
/// numbers.
void measure_heights(const cambium::Cloud::Matrix3X& points, const CartesianGrid& grid,
                     double heading, double height_offset, std::span<float> heights);

/// The descriptor of a view from the heights of its heading: shape().bins() numbers, columns of
/// unit length.
void describe(std::span<const float> heights, const CartesianGrid& grid, const CartesianView& view,
              std::span<float> descriptor);

/// T_base_view, both levelled. A lane k to the left in the reference is y = k * bin.
cambium::SE3 T_base_view(const CartesianGrid& grid, const CartesianView& view);

}  // namespace scan_context_pp
