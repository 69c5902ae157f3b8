// SPDX-License-Identifier: BSD-3-Clause
// What comes out is read back by other programs: GDAL's ogr2ogr and ogrinfo.
#include <csignal>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/projection.hpp"
#include "support/maps.hpp"

namespace cambium::testing {
namespace {

const GeoReference evo{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};

std::string output_of(const std::string& command) {
  const TemporaryFolder folder;
  const int status = std::system((command + " > " + (folder / "out").string() + " 2>&1").c_str());
  const std::string text = read_file(folder / "out");
  EXPECT_EQ(status, 0) << command << "\n" << text;
  return text;
}

class GeoPackage : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::system("ogr2ogr --version > /dev/null 2>&1") != 0)
      GTEST_SKIP() << "ogr2ogr is not installed (Debian: gdal-bin)";
  }
  std::filesystem::path write(const Atlas& atlas, const std::string& yaml = "{}") {
    const auto files =
        component<MapExporter>("geopackage", yaml)->write(atlas, folder_.path(), *make_context());
    return files.empty() ? std::filesystem::path{} : files.at(0);
  }
  /// The features of a layer in WGS 84 (or as they are, for one that is not on the globe).
  nlohmann::json features(const std::filesystem::path& file, const std::string& layer,
                          const std::string& options = "-t_srs EPSG:4979") {
    const std::string json = (folder_ / (layer + ".json")).string();
    output_of("ogr2ogr -f GeoJSON -lco RFC7946=NO -lco COORDINATE_PRECISION=10 " + options + " " +
              json + " " + file.string() + " " + layer);
    return nlohmann::json::parse(read_file(json)).at("features");
  }
  TemporaryFolder folder_;
};

/// Missions a and b in one island at Evo, c alone; a sees a tree from three nodes.
Atlas forest() {
  const std::vector<SE3> poses{SE3{}, SE3::from_yaw(0.5, {4, 1, 0}), SE3::from_yaw(1, {8, 0, 2})};
  Mission a = make_mission("a's", poses), b = make_mission("b", poses);
  for (std::size_t n = 0; n < poses.size(); ++n) {
    Tree tree;
    tree.base = poses[n].inverse() * Vec3(5, 6, -1);
    tree.dbh = 0.3 + 0.01 * double(n);
    tree.score = 0.75;
    tree.reconstructed = true;
    a.nodes[n].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(1, tree)});
    a.nodes[n].stamp = Stamp{1583840261 + std::int64_t(n), 39995392};
  }
  Atlas atlas = make_atlas({a, b, make_mission("c", {SE3{}})});
  atlas.islands = {{{0, 1}, evo}, {{2}, {}}};
  atlas.missions[1].island = 0;
  atlas.missions[2].island = 1;
  Loop yes{.tail = {0, 1}, .head = {1, 2}, .state = LoopState::accepted};
  yes.proposed_by = "scan_context", yes.registered_by = "gicp", yes.decided_by = "pcm";
  yes.reason = "consistent with 5 others", yes.weight = 0.875;
  yes.residual << 0.3, 0.4, 0, 0, 0, 0.1;
  yes.scores = {{"overlap", 0.75}, {"rmse", 0.05}};
  Loop no{.tail = {0, 0}, .head = {1, 1}, .state = LoopState::rejected};
  no.reason = "\"no\", said the verifier";
  atlas.loops = {no, yes, {.tail = {0, 2}, .head = {2, 0}}};
  return atlas;
}

void expect_at(const nlohmann::json& position, const Vec3& p_map) {
  const Geodetic g = map_to_geodetic(evo, p_map);
  EXPECT_NEAR(position.at(0).get<double>(), g.longitude, 1e-8);
  EXPECT_NEAR(position.at(1).get<double>(), g.latitude, 1e-8);
  EXPECT_NEAR(position.at(2).get<double>(), g.altitude, 1e-3);
}

TEST_F(GeoPackage, OtherProgramsFindTracksAndNodes) {
  const auto file = write(forest());
  const auto tracks = features(file, "tracks");
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0]["properties"]["mission"], "a's");
  EXPECT_EQ(tracks[0]["properties"]["nodes"], 3);
  ASSERT_EQ(tracks[0]["geometry"]["coordinates"].size(), 3u);
  expect_at(tracks[0]["geometry"]["coordinates"][2], {8, 0, 2});
  const auto nodes = features(file, "nodes");
  ASSERT_EQ(nodes.size(), 6u);
  const auto& second = nodes[1]["properties"];
  EXPECT_EQ(second["node"], 1);
  EXPECT_EQ(second["sec"], 1583840262);
  EXPECT_EQ(second["nsec"], 39995392);
  EXPECT_EQ(second["time"].get<std::string>().substr(0, 19), "2020-03-10T11:37:42");
  EXPECT_NEAR(second["heading"], 0.5 * 180 / M_PI, 1e-6);
}

TEST_F(GeoPackage, OtherProgramsFindLoopsAndStems) {
  const auto file = write(forest());
  const auto loops = features(file, "loops");
  ASSERT_EQ(loops.size(), 2u);  // the pair across islands has no place
  EXPECT_EQ(loops[0]["properties"]["reason"], "\"no\", said the verifier");
  EXPECT_TRUE(loops[0]["properties"]["weight"].is_null());
  const auto& yes = loops[1]["properties"];
  EXPECT_EQ(yes["verdict"], "accepted");
  EXPECT_EQ(yes["proposed_by"], "scan_context");
  EXPECT_EQ(yes["head_mission"], "b");
  EXPECT_EQ(yes["head_node"], 2);
  EXPECT_EQ(yes["weight"], 0.875);
  EXPECT_NEAR(yes["residual"], 0.5, 1e-12);
  EXPECT_EQ(yes["scores"], "overlap=0.75;rmse=0.05");
  const auto stems = features(file, "stems");
  ASSERT_EQ(stems.size(), 1u);
  EXPECT_NEAR(stems[0]["properties"]["dbh"], 0.31, 1e-9);
  EXPECT_EQ(stems[0]["properties"]["sightings"], 3);
  EXPECT_EQ(stems[0]["properties"]["missions"], "a's");
  expect_at(stems[0]["geometry"]["coordinates"], {5, 6, -1});
}

TEST_F(GeoPackage, LayersStateTheirSystem) {
  const std::string all = output_of("ogrinfo -so -al " + write(forest()).string());
  EXPECT_NE(all.find("ID[\"EPSG\",32635]"), std::string::npos) << all;
  EXPECT_NE(all.find("heights: ellipsoidal"), std::string::npos) << all;
  EXPECT_NE(all.find("Layer name: tracks_map_1"), std::string::npos) << all;
  EXPECT_NE(all.find("Cambium map frame, island 1"), std::string::npos) << all;
  EXPECT_EQ(features(write(forest()), "nodes_map_1", "")[0]["geometry"]["coordinates"],
            nlohmann::json::parse("[0.0, 0.0, 0.0]"));
}

TEST_F(GeoPackage, AnySystemOrNone) {
  const std::string finnish =
      output_of("ogrinfo -so -al " + write(forest(), "{crs: 'EPSG:3067'}").string());
  EXPECT_NE(finnish.find("ID[\"EPSG\",3067]"), std::string::npos) << finnish;
  const auto local = features(write(forest(), "{crs: map, layers: [stems]}"), "stems_map_0", "");
  EXPECT_EQ(local[0]["geometry"]["coordinates"], nlohmann::json::parse("[5.0, 6.0, -1.0]"));
  EXPECT_THROW(write(forest(), "{crs: 'EPSG:999999'}"), Error);
}

TEST_F(GeoPackage, TheSameMapGivesTheSameBytes) {
  const std::string first = read_file(write(forest()));
  std::filesystem::remove(folder_ / "map.gpkg");
  EXPECT_EQ(first, read_file(write(forest())));
}

TEST_F(GeoPackage, NothingToWriteIsNoFile) {
  EXPECT_TRUE(write(make_atlas({make_mission("a", {SE3{}})}), "{layers: [stems, loops]}").empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

// No file may grow beyond the limit, as on a full disk.
TEST_F(GeoPackage, AFullDiskLeavesNothing) {
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{20000, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  std::string message;
  try {
    write(forest());
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::data);
    message = e.what();
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_NE(message.find("map.gpkg: cannot be written"), std::string::npos) << message;
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace cambium::testing
