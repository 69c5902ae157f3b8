// SPDX-License-Identifier: BSD-3-Clause
// The map cut into square tiles, so that only one of them is in memory at a time.
#pragma once
#include <array>
#include <map>
#include <vector>

#include "cambium/atlas.hpp"
#include "cambium/context.hpp"

namespace las {

using Tile = std::array<int, 2>;  ///< x and y, whole tiles of the map frame

struct Tiles {
  std::map<Tile, std::vector<cambium::NodeRef>> nodes;  ///< that have points there, ascending
  float brightest = 0;                                  ///< the largest intensity of all clouds
};

/// Looks once at every cloud of the missions.
Tiles tiles_of(const cambium::Atlas& atlas, const std::vector<std::uint32_t>& missions,
               double width, const cambium::Context& context);

Tile tile_at(const cambium::Vec3& p_map, double width);

}  // namespace las
