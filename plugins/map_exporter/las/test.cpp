// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>
#include <set>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/projection.hpp"
#include "support/maps.hpp"
#include "support/plain_context.hpp"

namespace cambium::testing {
namespace {

const GeoReference evo{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};

/// A LAS file taken apart by the offsets of the specification.
struct Parsed {
  std::string text;
  template <class T>
  T at(std::size_t offset) const {
    T value{};
    EXPECT_LE(offset + sizeof value, text.size());
    std::memcpy(&value, text.data() + offset, sizeof value);
    return value;
  }
  std::uint64_t points() const { return at<std::uint64_t>(247); }
  std::size_t record() const { return at<std::uint16_t>(105); }
  std::size_t begin(std::size_t i) const { return at<std::uint32_t>(96) + i * record(); }
  Vec3 point(std::size_t i) const {
    Vec3 p;
    for (std::size_t k = 0; k < 3; ++k)
      p[Eigen::Index(k)] =
          at<std::int32_t>(begin(i) + 4 * k) * at<double>(131 + 8 * k) + at<double>(155 + 8 * k);
    return p;
  }
};

Parsed parse(const std::filesystem::path& file) { return {read_file(file)}; }

Cloud points(std::vector<float> xyz, std::vector<float> intensity = {}) {
  Cloud cloud;
  cloud.xyz = std::move(xyz);
  cloud.intensity = std::move(intensity);
  return cloud;
}

std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                         const std::string& yaml = "{}", int threads = 1) {
  return component<MapExporter>("las", yaml)->write(atlas, folder, *make_context(threads));
}

Atlas forest() {
  std::vector<Mission> all;
  for (int m = 0; m < 2; ++m) {
    std::vector<SE3> poses;
    for (int i = 0; i < 3; ++i) poses.push_back(SE3::from_yaw(0.3 * i, {20.0 * i, 2.0 * m, 1}));
    all.push_back(make_mission(std::string(1, char('a' + m)), poses));
    for (Node& node : all.back().nodes)
      node.payload = in_memory(forest_scan(node.T_mission_node, 1, 5000));
  }
  Atlas atlas = tied(make_atlas(all));
  atlas.islands[0].georeference = evo;
  return atlas;
}

TEST(LasExporter, APointIsWhereTheProjectionPutsIt) {
  const TemporaryFolder folder;
  Mission mission = make_mission("a", {SE3::from_yaw(M_PI / 2, {100, 20, 30})});
  mission.nodes[0].stamp = Stamp{1583840261, 500000000};  // 2020-03-10 11:37:41.5 UTC
  mission.nodes[0].payload = in_memory(points({1, 2, 3, 5, 0, 0}, {7, 300}));
  Atlas atlas = make_atlas({mission});
  atlas.islands[0].georeference = evo;
  const auto files = write(atlas, folder.path(), "{crs: 'EPSG:32635'}");
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0], folder / "map.las");
  const Parsed las = parse(files[0]);
  EXPECT_EQ(las.text.substr(0, 4), "LASF");
  EXPECT_EQ(las.text[24], 1);
  EXPECT_EQ(las.text[25], 4);
  EXPECT_EQ(las.at<std::uint16_t>(6), 17);   // adjusted GPS time, well-known text
  EXPECT_EQ(las.at<std::uint16_t>(90), 70);  // 10 March of a leap year
  EXPECT_EQ(las.at<std::uint16_t>(92), 2020);
  EXPECT_EQ(las.text[104], 6);
  ASSERT_EQ(las.points(), 2u);
  EXPECT_EQ(las.at<std::uint64_t>(255), 2u);  // first returns
  EXPECT_EQ(las.text.size(), las.begin(2));
  const Projection utm("EPSG:32635");
  const Vec3 expected = utm(map_to_geodetic(evo, {98, 21, 33}));
  EXPECT_LT((las.point(0) - expected).cwiseAbs().maxCoeff(), 0.00051);
  EXPECT_EQ(las.at<std::uint16_t>(las.begin(1) + 12), 300);
  EXPECT_EQ(las.at<std::uint16_t>(las.begin(0) + 20), 1);  // the mission
  // 1583840261.5 - 315964800 + 18 leap seconds - 1e9
  EXPECT_DOUBLE_EQ(las.at<double>(las.begin(0) + 22), 267875479.5);
  EXPECT_NEAR(las.at<double>(179), std::max(las.point(0).x(), las.point(1).x()), 1e-6);
  EXPECT_NEAR(las.at<double>(187), std::min(las.point(0).x(), las.point(1).x()), 1e-6);
  EXPECT_NE(las.text.find("PROJCS[\"WGS 84 / UTM zone 35N\""), std::string::npos);
  EXPECT_NE(las.text.find("1 a\n"), std::string::npos);
}

TEST(LasExporter, TilesHoldEveryPointOnce) {
  const TemporaryFolder one, many;
  const Parsed whole = parse(write(forest(), one.path(), "{voxel_size: 0, tile_size: 15}").at(0));
  EXPECT_EQ(whole.points(), 6u * 5000u);
  std::uint64_t sum = 0;
  const auto files = write(forest(), many.path(), "{voxel_size: 0, tile_size: 15, tiled: true}");
  for (const auto& file : files) sum += parse(file).points();
  EXPECT_GT(files.size(), 10u);
  EXPECT_EQ(sum, whole.points());
  const TemporaryFolder thin;
  EXPECT_LT(parse(write(forest(), thin.path(), "{voxel_size: 0.5}").at(0)).points(), sum);
}

TEST(LasExporter, AnyNumberOfThreadsWritesTheSameBytes) {
  const TemporaryFolder one, four;
  EXPECT_EQ(read_file(write(forest(), one.path(), "{}", 1).at(0)),
            read_file(write(forest(), four.path(), "{}", 4).at(0)));
}

// Each cloud once to find the tiles, then each tile's.
TEST(LasExporter, TellsHowFarItIs) {
  const TemporaryFolder folder;
  const CountingContext context;
  component<MapExporter>("las", "{tile_size: 15}")->write(forest(), folder.path(), context);
  EXPECT_GT(context.expected, 2 * 6u);
  EXPECT_EQ(context.done, context.expected);
}

TEST(LasExporter, MissionsAreSourcesAndColours) {
  const TemporaryFolder folder;
  const Parsed las = parse(write(forest(), folder.path(), "{colours: true}").at(0));
  EXPECT_EQ(las.text[104], 7);
  EXPECT_EQ(las.record(), 36u);
  std::set<std::pair<int, int>> seen;
  for (std::size_t i = 0; i < las.points(); ++i)
    seen.insert(
        {las.at<std::uint16_t>(las.begin(i) + 20), las.at<std::uint16_t>(las.begin(i) + 30)});
  EXPECT_EQ(seen, (std::set<std::pair<int, int>>{{1, 230 * 257}, {2, 86 * 257}}));
}

TEST(LasExporter, IntensitiesFillSixteenBits) {
  for (const auto& [given, expected] : std::vector<std::pair<float, int>>{
           {1.0f, 65535}, {0.5f, 65535 / 2 + 1}, {200, 200}, {1e6f, 65535}}) {
    const TemporaryFolder folder;
    Mission mission = make_mission("a", {SE3{}});
    mission.nodes[0].payload = in_memory(points({1, 0, 0, 5, 0, 0}, {given, NAN}));
    const Parsed las = parse(write(make_atlas({mission}), folder.path(), "{crs: map}").at(0));
    EXPECT_EQ(las.at<std::uint16_t>(las.begin(0) + 12), expected);
    EXPECT_EQ(las.at<std::uint16_t>(las.begin(1) + 12), 0);
  }
}

TEST(LasExporter, LabelsAreClasses) {
  Mission mission = make_mission("a", {SE3{}});
  Cloud cloud = points({0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0});
  cloud.label = {2, 64, 66, 9};
  mission.nodes[0].payload = in_memory(cloud);
  for (const auto& [classes, expected] : std::vector<std::pair<std::string, std::vector<int>>>{
           {"labels", {2, 64, 66, 9}}, {"standard", {2, 5, 5, 9}}}) {
    const TemporaryFolder folder;
    const Parsed las = parse(
        write(make_atlas({mission}), folder.path(), "{crs: map, classes: " + classes + "}").at(0));
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_EQ(int(las.at<std::uint8_t>(las.begin(i) + 16)), expected[i]) << classes;
  }
}

TEST(LasExporter, RefusesWhatCannotBeDone) {
  const TemporaryFolder folder;
  for (const char* crs : {"EPSG:999999", "nonsense", "EPSG:4326"})
    EXPECT_THROW(write(forest(), folder.path(), std::string("{crs: '") + crs + "'}"), Error) << crs;
  Atlas without = forest();
  without.islands[0].georeference.reset();
  EXPECT_TRUE(write(without, folder.path()).empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_EQ(write(without, folder.path(), "{crs: map}").size(), 1u);
}

}  // namespace
}  // namespace cambium::testing
