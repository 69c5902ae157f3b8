// SPDX-License-Identifier: BSD-3-Clause
#include <boost/crc.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <sstream>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

using Tree = boost::property_tree::ptree;

const GeoReference georeference{61.2, 25.1, 130, SE3::from_yaw(0.5, {10, 20, 3}), 0, 0};

Atlas two_islands() {
  const std::vector<SE3> poses{SE3{}, SE3::from_yaw(0, {100, 0, 0}),
                               SE3::from_yaw(0, {200, 50, 5})};
  Atlas atlas = make_atlas(
      {make_mission("a <&\"> b", poses), make_mission("b", poses), make_mission("lost", poses)});
  atlas.islands = {{{0, 1}, georeference}, {{2}, {}}};
  atlas.missions[1].island = 0;
  atlas.missions[2].island = 1;
  atlas.loops = {{.tail = {0, 1}, .head = {1, 2}, .state = LoopState::accepted},
                 {.tail = {0, 2}, .head = {1, 1}, .state = LoopState::rejected}};
  return atlas;
}

std::vector<Tree> placemarks(const std::filesystem::path& file) {
  Tree tree;  // throws when the file is not well formed
  boost::property_tree::read_xml(file.string(), tree);
  std::vector<Tree> out;
  for (const auto& [name, folder] : tree.get_child("kml.Document"))
    if (name == "Folder")
      for (const auto& [tag, placemark] : folder)
        if (tag == "Placemark") out.push_back(placemark);
  return out;
}

auto write(const Atlas& atlas, const std::filesystem::path& folder,
           const std::string& yaml = "{}") {
  return component<MapExporter>("kml", yaml)->write(atlas, folder, *make_context());
}

TEST(KmlExporter, DrawsTracksAndAcceptedLoops) {
  const TemporaryFolder folder;
  const auto files = write(two_islands(), folder.path());
  ASSERT_EQ(files.size(), 1u);
  const auto found = placemarks(files[0]);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].get<std::string>("name"), "a <&\"> b");
  EXPECT_EQ(found[2].get<std::string>("name"), "a <&\"> b 1 - b 2");
  EXPECT_EQ(placemarks(write(two_islands(), folder.path(), "{loops: false}")[0]).size(), 2u);
}

TEST(KmlExporter, CoordinatesLeadBackToTheMap) {
  const TemporaryFolder folder;
  const auto found =
      placemarks(write(two_islands(), folder.path(), "{altitude_mode: absolute}")[0]);
  EXPECT_EQ(found[1].get<std::string>("LineString.altitudeMode"), "absolute");
  std::istringstream text(found[1].get<std::string>("LineString.coordinates"));
  std::vector<Vec3> points;
  Geodetic g;
  for (char comma; text >> g.longitude >> comma >> g.latitude >> comma >> g.altitude;)
    points.push_back(georeference.T_map_enu * to_enu({61.2, 25.1, 130}, g));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_LT((points[2] - Vec3(200, 50, 5)).norm(), 1e-3);
}

TEST(KmlExporter, TracksMoveWithTime) {
  const TemporaryFolder folder;
  Atlas atlas = two_islands();
  Mission timeless = *atlas.missions[1].mission;
  for (Node& node : timeless.nodes) node.stamp.reset();
  atlas.missions[1].mission = std::make_shared<const Mission>(timeless);
  const auto found =
      placemarks(write(atlas, folder.path(), "{time_slider: true, loops: false}")[0]);
  ASSERT_EQ(found.size(), 2u);
  std::vector<std::string> times, places;
  for (const auto& [tag, value] : found[0].get_child("gx:Track")) {
    if (tag == "when") times.push_back(value.data());
    if (tag == "gx:coord") places.push_back(value.data());
  }
  EXPECT_EQ(times, (std::vector<std::string>{"1970-01-01T00:00:00.000Z", "1970-01-01T00:00:01.000Z",
                                             "1970-01-01T00:00:02.000Z"}));
  ASSERT_EQ(places.size(), 3u);
  std::istringstream text(places[2]);
  Geodetic g;
  ASSERT_TRUE(text >> g.longitude >> g.latitude >> g.altitude);
  EXPECT_LT((georeference.T_map_enu * to_enu({61.2, 25.1, 130}, g) - Vec3(200, 50, 5)).norm(),
            1e-3);
  EXPECT_TRUE(found[1].get_child_optional("LineString"));
}

// The figures of the ZIP format, and a checksum computed apart.
TEST(KmlExporter, AKmzIsTheKmlInAnArchive) {
  const TemporaryFolder one, other;
  const std::string kml = read_file(write(two_islands(), one.path())[0]);
  const auto files = write(two_islands(), other.path(), "{format: kmz}");
  EXPECT_EQ(files.at(0), other / "tracks.kmz");
  const std::string zip = read_file(files[0]);
  EXPECT_EQ(zip.substr(0, 4), std::string("PK\3\4"));
  EXPECT_EQ(zip.substr(30, 7), "doc.kml");
  EXPECT_EQ(zip.substr(37, kml.size()), kml);
  EXPECT_EQ(zip.substr(37 + kml.size(), 4), std::string("PK\1\2"));
  EXPECT_EQ(zip.substr(zip.size() - 22, 4), std::string("PK\5\6"));
  boost::crc_32_type crc;
  crc.process_bytes(kml.data(), kml.size());
  EXPECT_EQ(crc.checksum(), std::uint32_t(static_cast<unsigned char>(zip[14])) |
                                std::uint32_t(static_cast<unsigned char>(zip[15])) << 8 |
                                std::uint32_t(static_cast<unsigned char>(zip[16])) << 16 |
                                std::uint32_t(static_cast<unsigned char>(zip[17])) << 24);
}

TEST(KmlExporter, WritesNothingWithoutAGeoreference) {
  const TemporaryFolder folder;
  Atlas atlas = two_islands();
  atlas.islands[0].georeference.reset();
  EXPECT_TRUE(write(atlas, folder.path()).empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cambium::testing
