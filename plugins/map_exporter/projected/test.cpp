// SPDX-License-Identifier: BSD-3-Clause
#include <cstring>
#include <sstream>

#include "cambium/files.hpp"
#include "cambium/geodesy.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

const Geodetic evo{61.2, 25.1, 130};

/// A mission with nodes at these ENU positions at Evo, without turn.
Atlas at(const std::vector<Vec3>& places, const Geodetic& reference = evo) {
  std::vector<SE3> poses;
  for (const Vec3& p : places) poses.push_back({Quat::Identity(), p});
  Atlas atlas = make_atlas({make_mission("a", poses)});
  atlas.islands[0].georeference =
      GeoReference{reference.latitude, reference.longitude, reference.altitude, SE3{}, 0, 0};
  return atlas;
}

std::vector<std::filesystem::path> write(const Atlas& atlas, const std::filesystem::path& folder,
                                         const std::string& yaml) {
  return component<MapExporter>("projected", yaml)->write(atlas, folder, *make_context());
}

/// The poses of a file, and its remarks.
std::vector<SE3> poses_of(const std::filesystem::path& file, std::string* remarks = nullptr) {
  std::istringstream lines(read_file(file));
  std::vector<SE3> out;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#' && remarks) *remarks += line + "\n";
    if (line[0] == '#' || line.rfind("mission", 0) == 0) continue;
    for (char& c : line)
      if (c == ',') c = ' ';
    std::istringstream row(line);
    std::string mission;
    double id, sec, nsec;
    SE3 T;
    row >> mission >> id >> sec >> nsec >> T.t.x() >> T.t.y() >> T.t.z() >> T.q.x() >> T.q.y() >>
        T.q.z() >> T.q.w();
    EXPECT_TRUE(row);
    out.push_back(T);
  }
  return out;
}

// Golden values: Krueger's series to the fourth order, computed apart.
TEST(Projected, AgreesWithAnIndependentProjection) {
  const TemporaryFolder folder;
  const Vec3 north = to_enu(evo, {61.21, 25.1, 130});
  const auto files = write(at({Vec3::Zero(), north}), folder.path(), "{crs: 'EPSG:32635'}");
  std::string remarks;
  const auto poses = poses_of(files.at(0), &remarks);
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_NEAR(poses[0].t.x(), 397893.6786, 1e-3);
  EXPECT_NEAR(poses[0].t.y(), 6786548.3651, 1e-3);
  EXPECT_NEAR(poses[0].t.z(), 130, 1e-6);
  EXPECT_NEAR(poses[1].t.x(), 397926.0512, 1e-3);
  EXPECT_NEAR(poses[1].t.y(), 6787661.9164, 1e-3);
  EXPECT_NE(remarks.find("EPSG:32635 (WGS 84 / UTM zone 35N)"), std::string::npos) << remarks;
  EXPECT_NE(remarks.find("heights: ellipsoidal"), std::string::npos) << remarks;
}

// Moving the map as a whole would be 28 m wrong at 1 km: the grid is turned by 1.67 deg there.
TEST(Projected, EveryPoseByItself) {
  const TemporaryFolder folder;
  const auto poses =
      poses_of(write(at({Vec3::Zero(), Vec3(0, 1000, 0)}), folder.path(), "{}").at(0));
  const Vec3 moved = poses[0].t + Vec3(0, 1000, 0);
  EXPECT_NEAR((poses[1].t - moved).norm(), 29, 1.5);
  // And so is the robot: along the grid's axes it heads where its path does.
  const Vec3 heading = poses[0].q * Vec3::UnitY(), path = (poses[1].t - poses[0].t).normalized();
  EXPECT_LT((heading - path).norm(), 2e-4);
}

TEST(Projected, HeightsAboveAGeoidAreNamed) {
  const TemporaryFolder folder;
  std::string remarks;
  std::vector<SE3> poses;
  try {
    poses = poses_of(write(at({Vec3::Zero()}), folder.path(), "{crs: 'EPSG:32635+5773'}").at(0),
                     &remarks);
  } catch (const Error& e) {
    ASSERT_EQ(e.code(), ErrorCode::config);
    GTEST_SKIP() << "the grid of EGM96 is not installed: " << e.what();
  }
  EXPECT_NE(remarks.find("heights: EGM96 height"), std::string::npos) << remarks;
  EXPECT_NEAR(130 - poses[0].t.z(), 18, 2);  // the geoid at Evo
}

TEST(Projected, CloudsAreProjectedPointByPoint) {
  const TemporaryFolder folder;
  Atlas atlas = at({Vec3::Zero()});
  Cloud cloud;
  cloud.xyz = {0, 0, 0, 0, 1000, 0, 0, 1000.01f, 0};  // the last two in one voxel
  PayloadSources sources{{in_memory(cloud)}};
  atlas.payloads = std::make_shared<const PayloadSources>(sources);
  const auto files = write(atlas, folder.path(), "{crs: 'EPSG:32635'}");
  ASSERT_EQ(files.size(), 2u);
  const std::string text = read_file(files[1]);
  EXPECT_NE(text.find("element vertex 00000000000000000002"), std::string::npos);
  const auto begin = text.find("end_header\n") + 11;
  ASSERT_EQ(text.size() - begin, 2 * 28u);
  double p[3];
  std::memcpy(p, text.data() + begin + 28, sizeof p);
  const auto poses =
      poses_of(write(at({Vec3(0, 1000, 0)}), folder.path(), "{crs: 'EPSG:32635'}").at(0));
  EXPECT_NEAR(p[0], poses[0].t.x(), 1e-6);
  EXPECT_NEAR(p[1], poses[0].t.y(), 1e-6);
}

TEST(Projected, ChoosesTheUtmZone) {
  const TemporaryFolder folder;
  std::string north, south;
  poses_of(write(at({Vec3::Zero()}), folder.path(), "{}").at(0), &north);
  EXPECT_NE(north.find("EPSG:32635"), std::string::npos) << north;
  poses_of(write(at({Vec3::Zero()}, {-33.5, -70.5, 0}), folder.path(), "{}").at(0), &south);
  EXPECT_NE(south.find("EPSG:32719"), std::string::npos) << south;
}

TEST(Projected, RefusesWhatCannotBeDone) {
  const TemporaryFolder folder;
  const Atlas atlas = at({Vec3::Zero()});
  for (const char* crs : {"EPSG:999999", "nonsense", "EPSG:4326", "EPSG:5773"})
    EXPECT_THROW(write(atlas, folder.path(), std::string("{crs: '") + crs + "'}"), Error) << crs;
  Atlas without = atlas;
  without.islands[0].georeference.reset();
  EXPECT_TRUE(write(without, folder.path(), "{}").empty());
}

}  // namespace
}  // namespace cambium::testing
