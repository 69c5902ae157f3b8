// SPDX-License-Identifier: BSD-3-Clause
#include "monitor/changes_output.hpp"

namespace cambium::monitor {
namespace {

/// The first node of the first survey, and where it is in the map that the layer belongs to.
Json anchor_json(const Survey& before) {
  const std::uint32_t m = before.missions.front();
  const MissionState& state = before.clouds.missions[m];
  Json position = Json::array();
  for (const double v : state.T_map_node->front().t) position.push_back(rounded(v, 4));
  return {{"mission", state.mission->name}, {"position", std::move(position)}};
}

}  // namespace

Json layer_json(const Survey& before, const Survey& after, const Changes& changes,
                double cell_size) {
  Json stems = Json::array(), cells = Json::array();
  for (const StemChange& c : changes.stems) {
    Json row = stem_row(c, std::nullopt);
    for (const char* place : {"latitude", "longitude", "altitude"}) row.erase(place);
    stems.push_back(std::move(row));
  }
  for (const CellChange& c : changes.cells)
    cells.push_back(
        {rounded((c.cell[0] + 0.5) * cell_size, 3), rounded((c.cell[1] + 0.5) * cell_size, 3),
         c.level ? rounded(*c.level, 2) : Json(), c.ground ? rounded(*c.ground, 3) : Json(),
         c.canopy ? rounded(*c.canopy, 2) : Json()});
  return {{"kind", "changes"},         {"before", before.name},
          {"after", after.name},       {"anchor", anchor_json(before)},
          {"stems", std::move(stems)}, {"cell_width", cell_size},
          {"cells", std::move(cells)}};
}

}  // namespace cambium::monitor
