// SPDX-License-Identifier: BSD-3-Clause
// Parts of what queries and comparisons write.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "cambium/stems.hpp"
#include "monitor/survey.hpp"

namespace cambium::monitor {

using Json = nlohmann::ordered_json;

/// So many digits behind the point; null when the figure is not known.
Json rounded(double value, int digits);

/// Of an island that has one.
GeoReference island_reference(const Survey& survey, std::uint32_t island);

/// x, y, z in the map [m], latitude, longitude [deg] and altitude above the ellipsoid [m].
void add_place(Json& row, const Vec3& p_map, const std::optional<GeoReference>& g);

/// "mission_a;mission_b"
std::string mission_names(const Atlas& atlas, const Stem& stem);

/// GeoJSON (RFC 7946): longitude first, WGS 84.
Json position(const GeoReference& g, const Vec3& p_map);
Json point_feature(const GeoReference& g, const Vec3& p_map, const Json& properties);
std::string feature_collection(Json features);

}  // namespace cambium::monitor
