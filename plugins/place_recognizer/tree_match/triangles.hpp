// SPDX-License-Identifier: BSD-3-Clause
// Scalene triangles of neighbouring stems: what two stem maps of the same place have in common.
// Compare: M. Pierzchala et al., "Mapping forests using an unmanned ground vehicle with 3D LiDAR
// and graph-SLAM", 2018; TreeLoc (2026), whose triangles leave out the centre tree.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "stem_grid.hpp"

namespace tree_match {

struct TriangleLimits {
  int neighbours = 5;         ///< triangles are made of a stem and its nearest ones
  double reach = 12.0;        ///< neighbours are at most so far away [m]
  double min_side = 0.8;      ///< [m]
  double min_side_gap = 0.2;  ///< between two sides: else their order is a matter of noise [m]
  bool centre_tree = true;    ///< false: of two neighbours and a third one, without the centre
};

/// Vertex i lies opposite to side i; sides ascend. Headings and heights refer to vertex 0.
/// 28 bytes: a query walks through some ten thousands of them.
struct Triangle {
  static constexpr std::int8_t unknown_dz = -128;

  std::array<std::uint16_t, 3> side{};  ///< [mm]
  std::int16_t heading = 0;             ///< of vertex 1, 2 pi / 65536 a unit
  float x = 0, y = 0;                   ///< centroid, in the frame of the stems [m]
  std::uint32_t last = 0;               ///< the last node that saw one of its stems
  std::array<std::uint8_t, 3> dbh{};    ///< of the vertices [cm]; 0 when not known
  std::array<std::int8_t, 2> dz{};      ///< of the vertices 1 and 2 [5 cm]; unknown_dz
  std::uint8_t clockwise = 0;           ///< the chirality of the vertices 0, 1, 2
};
static_assert(sizeof(Triangle) == 28, "stored and hashed as bytes");

/// Every triangle once, in an order given by the order of the stems.
std::vector<Triangle> triangles(std::span<const Stem> stems, const StemGrid& grid,
                                const TriangleLimits& limits);

}  // namespace tree_match
