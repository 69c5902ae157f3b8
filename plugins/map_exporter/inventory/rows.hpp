// SPDX-License-Identifier: BSD-3-Clause
// A stem as a row of a table.
#pragma once
#include <optional>
#include <string>

#include "cambium/atlas.hpp"
#include "cambium/projection.hpp"
#include "cambium/stems.hpp"

namespace inventory {

/// Where and what a stem of the map is; the island says which map.
struct Entry {
  std::size_t id = 0, island = 0;
  const cambium::Stem& stem;
  std::optional<cambium::Geodetic> place;  ///< nothing in an island without georeference
};

/// The names of the columns, with the end of the line.
std::string header();

/// Coordinates of the system are empty without a place; diameters that are not known are empty.
std::string row(const cambium::Atlas& atlas, const Entry& entry,
                const cambium::Projection& to_grid);

}  // namespace inventory
