// SPDX-License-Identifier: BSD-3-Clause
// Lays the trees of one mission on those of another.
#pragma once
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "cambium/se3.hpp"

namespace canopy_match {

/// Trees by cells, so that those near a place are found.
class Neighbours {
 public:
  Neighbours(std::span<const cambium::Vec3> trees, double cell);
  static constexpr std::size_t none = ~std::size_t(0);
  /// The nearest tree within `radius` (at most the width of a cell), horizontally; or none.
  std::size_t nearest(const cambium::Vec3& p, double radius) const;

 private:
  std::span<const cambium::Vec3> trees_;
  double cell_;
  std::map<std::pair<long, long>, std::vector<std::size_t>> cells_;
};

struct OverlayLimits {
  double coarse_radius = 2.5;  ///< of matches, at first [m]
  double radius = 1.2;         ///< of matches, in the end: tops lean away from their stems [m]
  double cover = 8.0;          ///< the reference has looked where a tree of it is so near [m]
};

/// The trees of a query on those of a reference.
struct Overlay {
  cambium::SE3 T_reference_query;  ///< heading, position and height; missions are level
  std::size_t matches = 0;         ///< mutual nearest ones
  std::size_t seen = 0;            ///< trees of the query where the reference has looked
  /// Logarithm of how much likelier so many matches are than by chance, from the density of the
  /// reference's trees there.
  double score = 0;
  double rmse = 0;  ///< horizontal, of the matches [m]
};

/// Refines `start` (heading and position) by nearest trees and closed-form fits. The height is the
/// median over the matches of what their grounds differ by.
Overlay lay_over(std::span<const cambium::Vec3> reference, const Neighbours& of_reference,
                 std::span<const cambium::Vec3> query, const cambium::SE3& start,
                 const OverlayLimits& limits);

}  // namespace canopy_match
