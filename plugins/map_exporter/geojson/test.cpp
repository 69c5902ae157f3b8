// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

const GeoReference evo{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};

TEST(GeoJson, TracksAreOnTheGlobe) {
  const TemporaryFolder folder;
  Atlas atlas = make_atlas({make_mission("a \"quoted\"", {{}, SE3::from_yaw(1, {100, 0, 2})}),
                            make_mission("b", {SE3{}})});
  atlas.islands[0].georeference = evo;
  const auto exporter = component<MapExporter>("geojson");
  const auto files = exporter->write(atlas, folder.path(), *make_context());
  ASSERT_EQ(files.size(), 1u);
  const auto json = nlohmann::json::parse(read_file(files[0]));
  EXPECT_EQ(json.at("type"), "FeatureCollection");
  ASSERT_EQ(json.at("features").size(), 1u);  // b has no georeference
  const auto& feature = json["features"][0];
  EXPECT_EQ(feature.at("properties").at("mission"), "a \"quoted\"");
  EXPECT_EQ(feature.at("geometry").at("type"), "LineString");
  const auto& end = feature["geometry"]["coordinates"][1];
  const Geodetic expected = map_to_geodetic(evo, {100, 0, 2});
  EXPECT_NEAR(end[0].get<double>(), expected.longitude, 1e-9);
  EXPECT_NEAR(end[1].get<double>(), expected.latitude, 1e-9);
  EXPECT_NEAR(end[2].get<double>(), expected.altitude, 1e-3);
}

TEST(GeoJson, OneNodeIsAPointAndNothingIsNoFile) {
  const TemporaryFolder folder;
  Atlas atlas = make_atlas({make_mission("a", {SE3{}})});
  const auto exporter = component<MapExporter>("geojson");
  EXPECT_TRUE(exporter->write(atlas, folder.path(), *make_context()).empty());
  atlas.islands[0].georeference = evo;
  const auto files = exporter->write(atlas, folder.path(), *make_context());
  const auto json = nlohmann::json::parse(read_file(files.at(0)));
  EXPECT_EQ(json["features"][0]["geometry"]["type"], "Point");
}

}  // namespace
}  // namespace cambium::testing
