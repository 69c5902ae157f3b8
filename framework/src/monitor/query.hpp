// SPDX-License-Identifier: BSD-3-Clause
// What a map knows of a place.
#pragma once
#include <nlohmann/json.hpp>

#include "cambium/stems.hpp"
#include "monitor/place.hpp"
#include "monitor/survey.hpp"

namespace cambium::monitor {

using Json = nlohmann::ordered_json;

struct QueryOptions {
  Place place;
  double reach = 60;  ///< nodes farther from the place are taken not to have seen it [m]
  StemOptions stems;
};

struct SeenNode {
  NodeRef node;
  bool inside = false;     ///< it stands in the place
  std::size_t points = 0;  ///< of its cloud in the place
};

struct SeenStem {
  std::uint32_t island = 0;
  Stem stem;
};

struct QueryResult {
  std::vector<SeenNode> nodes;  ///< that stand in the place or have points there, ascending
  std::vector<SeenStem> stems;  ///< whose bases lie in the place
  /// The map with what was seen of the place alone: clouds and trees outside are cut away, when
  /// they are loaded.
  Atlas cropped;
};

/// Looks into every island with a georeference; `warn` hears of the others. Throws Error(config)
/// when none has one, Error(check) when no mission saw the place.
QueryResult query(const Survey& survey, const QueryOptions& options, const Context& context);

/// `missions`, `nodes`, `stems`: see docs/monitoring.md.
Json query_json(const Survey& survey, const QueryResult& result);

/// The stems as GeoJSON.
std::string query_stems_geojson(const Survey& survey, const QueryResult& result);

/// For people: one line a mission, then the stems.
std::string query_text(const Survey& survey, const QueryResult& result);

}  // namespace cambium::monitor
