// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <cstring>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "cambium/projection.hpp"
#include "support/maps.hpp"

namespace cambium::testing {
namespace {

/// A LAS 1.2 file, built by the offsets of the specification.
struct LasText {
  std::string bytes = std::string(227, '\0');
  template <class T>
  void put(std::size_t at, T value) {
    std::memcpy(bytes.data() + at, &value, sizeof value);
  }
  LasText(const std::vector<Vec3>& points, const std::string& record = {}) {
    bytes.replace(0, 4, "LASF");
    put(24, char(1)), put(25, char(2));
    put(90, std::uint16_t(32)), put(92, std::uint16_t(2021));  // 1 February
    put(94, std::uint16_t(227));
    put(96, std::uint32_t(227 + record.size()));
    put(100, std::uint32_t(!record.empty()));
    put(105, std::uint16_t(20));
    put(107, std::uint32_t(points.size()));
    for (std::size_t k = 0; k < 3; ++k) {
      double low = 1e300, high = -1e300;
      for (const Vec3& p : points)
        low = std::min(low, p[Eigen::Index(k)]), high = std::max(high, p[Eigen::Index(k)]);
      put(131 + 8 * k, 0.001);
      put(155 + 8 * k, std::floor(points.at(0)[Eigen::Index(k)]));
      put(179 + 16 * k, high), put(187 + 16 * k, low);
    }
    bytes += record;
    for (const Vec3& p : points) {
      std::string row(20, '\0');
      for (std::size_t k = 0; k < 3; ++k) {
        const double origin = std::floor(points[0][Eigen::Index(k)]);
        const auto stored = std::int32_t(std::lround((p[Eigen::Index(k)] - origin) * 1000));
        std::memcpy(row.data() + 4 * k, &stored, 4);
      }
      row[12] = 42;
      row[15] = char(2 | 0x20);  // ground; the flag is not part of the class
      bytes += row;
    }
  }
};

std::string record(std::uint16_t id, const std::string& content) {
  std::string head(54, '\0');
  head.replace(2, 15, "LASF_Projection");
  const auto size = std::uint16_t(content.size());
  std::memcpy(head.data() + 18, &id, 2);
  std::memcpy(head.data() + 20, &size, 2);
  return head + content;
}

std::string geotiff(std::vector<std::uint16_t> keys) {
  std::vector<std::uint16_t> words{1, 1, 0, std::uint16_t(keys.size() / 4)};
  words.insert(words.end(), keys.begin(), keys.end());
  return record(34735, std::string(reinterpret_cast<const char*>(words.data()), 2 * words.size()));
}

const std::string utm35 = geotiff({1024, 0, 1, 1, 3072, 0, 1, 32635});
const Vec3 evo{397893.5, 6786548.25, 130};

class LasTiles : public ::testing::Test {
 protected:
  void file(const std::string& name, const std::string& bytes) {
    write_file(folder_ / name, bytes);
  }
  Mission read(const std::string& name = "", const std::string& yaml = "{}") const {
    const auto path = name.empty() ? folder_.path() : folder_ / name;
    const auto reader = component<MissionReader>("las_tiles", yaml);
    EXPECT_TRUE(reader->accepts(path));
    return reader->read(path, *make_context());
  }
  /// What refuses it, when it is read or when its points are.
  std::string refusal(const std::string& bytes, const std::string& yaml = "{}") {
    file("bad.las", bytes);
    try {
      read("bad.las", yaml).nodes.at(0).payload->load();
    } catch (const Error& e) {
      return e.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
};

// The points of the cloud lead back to the coordinates of the file.
TEST_F(LasTiles, PointsAreWhereTheirSystemPutsThem) {
  const std::vector<Vec3> first{evo, evo + Vec3(40, 0, 10), evo + Vec3(0, 30, 2)};
  const std::vector<Vec3> second{evo + Vec3(1000, 500, 0), evo + Vec3(1020, 540, 20)};
  file("b.las", LasText(second, utm35).bytes);
  file("a.las", LasText(first, utm35).bytes);
  const Mission m = read();
  EXPECT_TRUE(m.warnings.empty());
  ASSERT_EQ(m.nodes.size(), 2u);
  ASSERT_EQ(m.edges.size(), 1u);
  ASSERT_TRUE(m.georeference);
  const Projection utm("EPSG:32635");
  for (const auto& [node, given] : {std::pair{m.nodes[0], first}, std::pair{m.nodes[1], second}}) {
    const Cloud cloud = *node.payload->load().cloud;
    ASSERT_EQ(cloud.size(), given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      const Vec3 p(cloud.points().col(Eigen::Index(i)).cast<double>());
      const Vec3 back = utm(map_to_geodetic(*m.georeference, node.T_mission_node * p));
      EXPECT_LT((back - given[i]).norm(), 1e-3);
    }
    EXPECT_EQ(cloud.label, std::vector<std::uint8_t>(given.size(), 2));
    EXPECT_EQ(cloud.intensity[0], 42);
  }
  // A true kilometre, not one of the grid: at Evo that is 0.3 m apart, and turned by 29 m.
  EXPECT_GT((m.nodes[1].T_mission_node.t - m.nodes[0].T_mission_node.t - Vec3(990, 505, 0)).norm(),
            20);
  ASSERT_EQ(m.fixes.size(), 2u);
  EXPECT_EQ(m.fixes[1].stamp, (Stamp{1612137601, 0}));  // 2021-02-01, the second tile
  EXPECT_NEAR(m.fixes[1].covariance(0, 0), 0.01, 1e-12);
}

TEST_F(LasTiles, AFileIsAMissionOfOneNode) {
  file("plot.las", LasText({evo, evo + Vec3(1, 1, 1)}, utm35).bytes);
  const Mission m = read("plot.las");
  EXPECT_EQ(m.name, "plot");
  EXPECT_EQ(m.nodes.size(), 1u);
}

TEST_F(LasTiles, WithoutASystemTheMissionIsNotOnTheGlobe) {
  file("plot.las", LasText({evo, evo + Vec3(10, 1, 1)}).bytes);
  const Mission m = read();
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_NE(m.warnings[0].find("states no coordinate reference system"), std::string::npos);
  EXPECT_FALSE(m.georeference);
  EXPECT_TRUE(m.fixes.empty());
  EXPECT_LT(m.nodes[0].T_mission_node.t.norm(), 10);
  const Mission named = read("", "{crs: 'EPSG:32635'}");
  ASSERT_TRUE(named.georeference);
  EXPECT_NEAR(named.georeference->latitude, 61.2, 0.01);
}

TEST_F(LasTiles, HeightsAboveAnUnknownGeoidAreAWarning) {
  // NAVD88 by GEOID12B: a grid of North America, of no use at Evo.
  file("plot.las",
       LasText({evo, evo + Vec3(10, 1, 1)}, geotiff({3072, 0, 1, 32635, 4096, 0, 1, 5703})).bytes);
  const Mission m = read();
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_NE(m.warnings[0].find("geoid"), std::string::npos) << m.warnings[0];
  ASSERT_TRUE(m.georeference);
  EXPECT_NEAR(m.georeference->altitude, 130, 1e-6);
}

// What `export: las` writes reads back: labels are classes, and every point is where it was.
TEST_F(LasTiles, ReadsWhatCambiumWrites) {
  Mission mission =
      make_mission("a", {SE3::from_yaw(0.3, {20, 5, 1}), SE3::from_yaw(1, {25, 5, 1})});
  std::vector<Vec3> expected;
  std::vector<std::uint8_t> labels;
  const GeoReference g{61.2, 25.1, 130, SE3::from_yaw(0.4, {10, 20, 3}), 0, 0};
  for (std::size_t n = 0; n < 2; ++n) {
    Cloud cloud;
    for (std::uint8_t i = 0; i < 4; ++i) {
      const Vec3 p(i * 2.0, 1.0 + double(n), 0.5 * i);
      for (const double v : p) cloud.xyz.push_back(float(v));
      cloud.label.push_back(std::array<std::uint8_t, 4>{2, 64, 65, 66}[i]);
      labels.push_back(cloud.label.back());
      const Geodetic at = map_to_geodetic(g, mission.nodes[n].T_mission_node * p);
      expected.push_back(to_enu({61.2, 25.1, 130}, at));
    }
    mission.nodes[n].payload = in_memory(cloud);
  }
  Atlas atlas = make_atlas({mission});
  atlas.islands[0].georeference = g;
  component<MapExporter>("las", "{voxel_size: 0}")->write(atlas, folder_.path(), *make_context());
  const Mission back = read();
  const Cloud cloud = *back.nodes.at(0).payload->load().cloud;
  ASSERT_EQ(cloud.size(), expected.size());
  EXPECT_EQ(cloud.label, labels);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const Vec3 p(cloud.points().col(Eigen::Index(i)).cast<double>());
    const Geodetic at = map_to_geodetic(*back.georeference, back.nodes[0].T_mission_node * p);
    EXPECT_LT((to_enu({61.2, 25.1, 130}, at) - expected[i]).norm(), 0.0015);
  }
}

TEST_F(LasTiles, BadFilesSayWhatIsWrong) {
  const auto expect = [&](const std::string& bytes, const std::string& part,
                          const std::string& yaml = "{}") {
    const std::string message = refusal(bytes, yaml);
    EXPECT_NE(message.find(part), std::string::npos) << part << ": " << message;
  };
  const LasText good({evo, evo + Vec3(1, 1, 1)}, utm35);
  const auto with = [&](std::size_t at, auto value) {
    LasText out = good;
    out.put(at, value);
    return out.bytes;
  };
  EXPECT_EQ(refusal(good.bytes), "accepted");
  expect(with(107, std::uint32_t(3)), "promises 3 points, the file holds 2");
  expect(good.bytes.substr(0, good.bytes.size() - 1), "promises 2 points, the file holds 1");
  expect(with(107, std::uint32_t(0)), "no LAS or LAZ file with points");
  expect(with(179, -1e9), "extent in its header is none");
  expect(with(187, std::nan("")), "extent in its header is none");
  expect(LasText({evo, evo}, geotiff({3072, 0, 1, 60001})).bytes,
         "coordinate reference system is of no use: PROJ knows no");
  expect(LasText({evo, evo}, record(2112, "PROJCS[\"nonsense\"]")).bytes, "is of no use");
  expect(good.bytes, "PROJ knows no coordinate reference system 'EPSG:1'", "{crs: 'EPSG:1'}");
  // A point far outside of the stated extent.
  LasText stray({evo, evo + Vec3(1, 1, 1)}, utm35);
  stray.put(stray.bytes.size() - 20, std::int32_t(400'000'000));
  expect(stray.bytes, "100 km");
}

TEST_F(LasTiles, TilesOfDifferentSystemsAreRefused) {
  file("a.las", LasText({evo, evo}, utm35).bytes);
  file("b.las", LasText({evo, evo}, geotiff({3072, 0, 1, 3067})).bytes);
  try {
    read();
    FAIL() << "expected an error";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::data);
    EXPECT_NE(std::string(e.what()).find("another coordinate reference system than a.las"),
              std::string::npos);
  }
}

TEST_F(LasTiles, LeavesMissionFoldersToTheirReader) {
  file("cloud.las", LasText({evo, evo}, utm35).bytes);
  file("slam_pose_graph.g2o", "");
  EXPECT_FALSE(component<MissionReader>("las_tiles")->accepts(folder_.path()));
}

}  // namespace
}  // namespace cambium::testing
