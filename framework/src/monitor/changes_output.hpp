// SPDX-License-Identifier: BSD-3-Clause
// A comparison as tables, maps and a summary; docs/monitoring.md has the columns.
#pragma once
#include "monitor/changes.hpp"

namespace cambium::monitor {

/// Of a tree by the names of the columns; places on the globe where there is a georeference.
Json stem_row(const StemChange& change, const std::optional<GeoReference>& georeference);

std::string stems_csv(const Survey& before, const Changes& changes);
std::string cells_csv(const Survey& before, const Changes& changes, double cell_size);

/// Nothing when the first survey has no georeference.
std::optional<std::string> stems_geojson(const Survey& before, const Changes& changes);
std::optional<std::string> cells_geojson(const Survey& before, const Changes& changes,
                                         double cell_size);

/// What a page of the first survey's run shows on top of its map: trees and cells in that map, and
/// by `anchor`, a node and its pose, which map that is. docs/view.md describes it.
Json layer_json(const Survey& before, const Survey& after, const Changes& changes,
                double cell_size);

/// Counts, growth, heights and how the maps were brought together.
Json summary_json(const Survey& before, const Survey& after, const Changes& changes);
std::string summary_text(const Json& summary);

}  // namespace cambium::monitor
