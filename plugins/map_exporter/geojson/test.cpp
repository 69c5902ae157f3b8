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
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0], folder / "tracks.geojson");
  EXPECT_EQ(files[1], folder / "nodes.geojson");
  const auto json = nlohmann::json::parse(read_file(files[0]));
  EXPECT_EQ(json.at("type"), "FeatureCollection");
  ASSERT_EQ(json.at("features").size(), 1u);  // b has no georeference
  const auto& feature = json["features"][0];
  EXPECT_EQ(feature.at("properties").at("mission"), "a \"quoted\"");
  EXPECT_EQ(feature.at("properties").at("last"), "1970-01-01T00:00:01.000Z");
  EXPECT_EQ(feature.at("geometry").at("type"), "LineString");
  const auto& end = feature["geometry"]["coordinates"][1];
  const Geodetic expected = map_to_geodetic(evo, {100, 0, 2});
  EXPECT_NEAR(end[0].get<double>(), expected.longitude, 1e-9);
  EXPECT_NEAR(end[1].get<double>(), expected.latitude, 1e-9);
  EXPECT_NEAR(end[2].get<double>(), expected.altitude, 1e-3);
}

TEST(GeoJson, LoopsAndStemsHaveTheirFigures) {
  const TemporaryFolder folder;
  Mission mission = make_mission("a", {SE3{}, SE3::from_yaw(1, {3, 0, 0})});
  Tree tree;
  tree.base = {1, 2, 0};
  tree.dbh = std::numeric_limits<double>::quiet_NaN();
  tree.reconstructed = true;
  mission.nodes[0].payload =
      in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(1, tree)});
  Atlas atlas = make_atlas({mission});
  atlas.islands[0].georeference = evo;
  Loop loop{.tail = {0, 0}, .head = {0, 1}, .state = LoopState::rejected};
  loop.reason = "too few\npoints";
  atlas.loops = {loop};
  const auto files = component<MapExporter>("geojson", "{layers: [stems, loops], min_sightings: 1}")
                         ->write(atlas, folder.path(), *make_context());
  ASSERT_EQ(files.size(), 2u);
  const auto loops = nlohmann::json::parse(read_file(folder / "loops.geojson"))["features"];
  EXPECT_EQ(loops.at(0)["properties"]["verdict"], "rejected");
  EXPECT_EQ(loops[0]["properties"]["reason"], "too few\npoints");
  EXPECT_EQ(loops[0]["geometry"]["coordinates"].size(), 2u);
  const auto stems = nlohmann::json::parse(read_file(folder / "stems.geojson"))["features"];
  ASSERT_EQ(stems.size(), 1u);
  EXPECT_TRUE(stems[0]["properties"]["dbh"].is_null());
  EXPECT_EQ(stems[0]["geometry"]["type"], "Point");
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
