// SPDX-License-Identifier: BSD-3-Clause
// Mission folders through the real loader.
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

namespace cambium {
namespace {

namespace fs = std::filesystem;

const std::string pcd_head =
    "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F "
    "F\n"
    "COUNT 1 1 1\nWIDTH 2\nHEIGHT 1\nVIEWPOINT 10 0 0 0 0 0 1\nPOINTS 2\n";
const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";
const std::vector<float> two_points = {1, 2, 3, -4.5, 5, 6};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

template <class T>
std::string bytes(const std::vector<T>& values) {
  std::string out(values.size() * sizeof(T), '\0');
  std::memcpy(out.data(), values.data(), out.size());
  return out;
}

/// A mission of two stamped poses whose first cloud is the given file.
class MissionOnDisk {
 public:
  MissionOnDisk() {
    write_file(path() / "slam_pose_graph.g2o",
               "PLATFORM_ID 3\nVERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 10 5\n"
               "VERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 11 0\n");
    fs::create_directories(path() / "individual_clouds");
  }
  MissionOnDisk& cloud(const std::string& name, const std::string& content) {
    write_file(path() / "individual_clouds" / name, content);
    return *this;
  }
  fs::path path() const { return fs::path(folder_.path()); }
  Mission read(const std::string& params = "{}") const {
    return testing::component<MissionReader>("mission_folder", params)
        ->read(path(), *testing::make_context());
  }
  Cloud first_cloud(const std::string& params = "{}") const {
    return *read(params).nodes[0].payload->load().cloud;
  }
  std::string refusal() const {
    try {
      first_cloud();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::data);
      return error.what();
    }
    return "accepted";
  }

 private:
  testing::TemporaryFolder folder_;
};

Cloud pcd(const std::string& content, const std::string& params = "{}") {
  return MissionOnDisk().cloud("cloud_10_000000005.pcd", content).first_cloud(params);
}

Cloud ply(const std::string& content) {
  return MissionOnDisk().cloud("cloud_10_000000005.ply", content).first_cloud();
}

bool contains(const std::vector<std::string>& warnings, const std::string& part) {
  for (const auto& warning : warnings)
    if (warning.find(part) != warning.npos) return true;
  return false;
}

TEST(MissionFolder, GraphPayloadsAndNames) {
  MissionOnDisk disk;
  disk.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n");
  const Mission m = disk.read();
  EXPECT_EQ(m.name, disk.path().filename().string());
  EXPECT_EQ(m.folder, disk.path());
  EXPECT_EQ(m.platform_id, 3);
  ASSERT_TRUE(m.nodes[0].payload);
  EXPECT_FALSE(m.nodes[1].payload);
  EXPECT_EQ(m.nodes[0].payload->load().cloud->xyz, two_points);
  EXPECT_FALSE(m.nodes[0].payload->load().trees);
  EXPECT_TRUE(contains(m.warnings, "1 of 2 nodes have no cloud: 11_0"));
}

TEST(MissionFolder, PicturesAreThePayloadOfTheirNode) {
  MissionOnDisk disk;
  std::filesystem::create_directory(disk.path() / "individual_images");
  write_file(disk.path() / "individual_images/image_10_000000005.jpg", "a picture");
  write_file(disk.path() / "individual_images/image_x.jpg", "of no stamp");
  const Mission mission = disk.read();
  ASSERT_TRUE(mission.nodes[0].payload);
  const Payload payload = mission.nodes[0].payload->load();
  EXPECT_FALSE(payload.cloud);
  ASSERT_TRUE(payload.images);
  EXPECT_EQ(read_file(payload.images->at(0).file), "a picture");
  EXPECT_NE(mission.nodes[0].payload->where().find("image_10"), std::string::npos);
  const Digest before = mission.nodes[0].payload->digest();
  write_file(disk.path() / "individual_images/image_10_000000005.jpg", "another picture");
  EXPECT_NE(before, disk.read().nodes[0].payload->digest());
}

TEST(MissionFolder, TrailingSlashNamesTheSameMission) {
  MissionOnDisk disk;
  const auto reader = testing::component<MissionReader>("mission_folder");
  EXPECT_EQ(reader->read(disk.path() / "", *testing::make_context()).name, disk.read().name);
}

TEST(MissionFolder, BareGraphIsAMissionWithoutPayloads) {
  MissionOnDisk disk;
  const auto reader = testing::component<MissionReader>("mission_folder");
  const Mission m = reader->read(disk.path() / "slam_pose_graph.g2o", *testing::make_context());
  EXPECT_EQ(m.name, "slam_pose_graph");
  EXPECT_EQ(m.nodes.size(), 2u);
}

TEST(MissionFolder, EveryEncodingOfACloudGivesTheSamePoints) {
  EXPECT_EQ(pcd(pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n").xyz, two_points);
  EXPECT_EQ(pcd(pcd_head + "DATA binary\n" + bytes(two_points)).xyz, two_points);
  // LZF, one run of 24 literal bytes; fields one after another.
  const std::string by_field = bytes<float>({1, -4.5, 2, 5, 3, 6});
  EXPECT_EQ(pcd(pcd_head + "DATA binary_compressed\n" + bytes<std::uint32_t>({25, 24}) + '\x17' +
                by_field)
                .xyz,
            two_points);
  EXPECT_EQ(ply(ply_head + "1 2 3\n-4.5 5 6\n").xyz, two_points);
  EXPECT_EQ(ply(replaced(ply_head, "ascii", "binary_little_endian") + bytes(two_points)).xyz,
            two_points);
}

TEST(MissionFolder, OtherFieldsAndTypes) {
  const std::string head =
      "VERSION 0.7\nFIELDS intensity x y z normal_x normal_y normal_z\nSIZE 2 8 8 8 4 4 4\n"
      "TYPE U F F F F F F\nCOUNT 1 1 1 1 1 1 1\nWIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA binary\n";
  const Cloud c =
      pcd(head + bytes<std::uint16_t>({777}) + bytes<double>({1, 2, 3}) + bytes<float>({0, 0, 2}));
  EXPECT_EQ(c.xyz, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(c.intensity, std::vector<float>{777});
  EXPECT_EQ(c.normals, (std::vector<float>{0, 0, 1}));
}

TEST(MissionFolder, LabelsAreWholeNumbersOfAByte) {
  const std::string head =
      "VERSION 0.7\nFIELDS x y z label\nSIZE 4 4 4 2\nTYPE F F F U\nCOUNT 1 1 1 1\nWIDTH 3\nHEIGHT 1\n"
      "POINTS 3\nDATA ascii\n";
  EXPECT_EQ(pcd(head + "1 2 3 64\nnan 2 3 2\n4 5 6 700\n").label, (std::vector<std::uint8_t>{64, 0}));
  EXPECT_TRUE(pcd(pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n").label.empty());
}

TEST(MissionFolder, NotFinitePointsAreRemovedAndCounted) {
  MissionOnDisk disk;
  disk.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\nnan 2 3\n-4.5 5 6\n");
  EXPECT_EQ(disk.first_cloud().xyz, (std::vector<float>{-4.5, 5, 6}));
  EXPECT_TRUE(contains(disk.read("{check_payloads: true}").warnings, "of which 1 are removed"));
}

TEST(MissionFolder, ViewpointOnRequest) {
  const std::string content = pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n";
  const Cloud c = pcd(content, "{apply_viewpoint: true}");
  EXPECT_NEAR(c.xyz[0], 10 - 1, 1e-6);  // half a turn about z at (10, 0, 0)
  EXPECT_NEAR(c.xyz[1], -2, 1e-6);
  MissionOnDisk disk;
  disk.cloud("cloud_10_000000005.pcd", content);
  EXPECT_NE(disk.read().nodes[0].payload->digest(),
            disk.read("{apply_viewpoint: true}").nodes[0].payload->digest());
}

TEST(MissionFolder, DigestsFollowTheContent) {
  MissionOnDisk a, b;
  a.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n");
  b.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n");
  EXPECT_EQ(a.read().nodes[0].payload->digest(), b.read().nodes[0].payload->digest());
  b.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 7\n");
  EXPECT_NE(a.read().nodes[0].payload->digest(), b.read().nodes[0].payload->digest());
}

TEST(MissionFolder, EmptyCloudIsAWarning) {
  MissionOnDisk disk;
  disk.cloud(
      "cloud_10_000000005.pcd",
      replaced(replaced(pcd_head, "WIDTH 2", "WIDTH 0"), "POINTS 2", "POINTS 0") + "DATA binary\n");
  EXPECT_TRUE(disk.first_cloud().empty());
  EXPECT_TRUE(contains(disk.read("{check_payloads: true}").warnings, "1 clouds are empty"));
}

TEST(MissionFolder, DamagedCloudsSayWhatWasExpected) {
  const auto refusal = [](const std::string& content, const char* extension = ".pcd") {
    return MissionOnDisk().cloud(std::string("cloud_10_000000005") + extension, content).refusal();
  };
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), message.npos) << message;
    EXPECT_NE(message.find("cloud_10_000000005"), message.npos) << message;
  };
  expect(refusal(""), "is an empty file");
  expect(refusal(pcd_head + "DATA binary\n" + bytes<float>({1, 2, 3, 4})),
         "the header promises 2 points, the file holds 1");
  expect(refusal(pcd_head + "DATA binary\n" + bytes<float>(std::vector<float>(9, 1.f))), "holds 3");
  expect(refusal(pcd_head + "DATA ascii\n1 2 3\n"), "promises 2 points, the file holds 1");
  expect(refusal(pcd_head + "DATA ascii\n1 2 3\n1 2 3\n1 2 3\n"), "holds 3");
  expect(refusal(pcd_head + "DATA ascii\n1 2 3\n4 five 6\n"), "point 2 is not of 3 numbers");
  expect(refusal(ply_head + "1 2 3\n4 5\n", ".ply"), "point 2 is not of 3 numbers");
  expect(refusal(pcd_head + "DATA binary_compressed\n" + bytes<std::uint32_t>({25, 24}) + "abc"),
         "truncated");
  expect(refusal(pcd_head + "DATA binary_compressed\n"), "expected 2 points of 12 bytes");
  expect(refusal(pcd_head + "DATA zip\n"), "'zip'");
  expect(refusal(replaced(pcd_head, "POINTS 2", "POINTS 7") + "DATA ascii\n1 2 3\n1 2 3\n"),
         "says POINTS 7, but WIDTH x HEIGHT is 2");
  expect(refusal(replaced(pcd_head, "WIDTH 2", "WIDTH -2") + "DATA ascii\n"), "WIDTH '-2'");
  expect(refusal(replaced(pcd_head, "x y z", "x y w") + "DATA ascii\n1 2 3\n1 2 3\n"),
         "no field 'z'");
  expect(refusal(replaced(pcd_head, "x y z", "x y") + "DATA ascii\n1 2\n1 2\n"), "lengths");
  expect(refusal(std::string(4000, '\x7f')), "is no PCD file");
  expect(refusal(ply_head + "1 2 3\n", ".ply"), "promises 2 points, the file holds 1");
  expect(refusal(replaced(ply_head, "ascii", "binary_little_endian") + "abc", ".ply"), "holds 0");
  expect(refusal("ply\nformat ascii 1.0\n", ".ply"), "no end_header");
  expect(refusal("solid", ".ply"), "does not begin with 'ply'");
}

// Whatever a disk does to a file: an error of the data or a cloud, never a crash.
TEST(MissionFolder, RandomDamageNeverCrashes) {
  const std::string by_field = bytes<float>({1, -4.5, 2, 5, 3, 6});
  const std::pair<std::string, std::string> files[] = {
      {"pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n"},
      {"pcd", pcd_head + "DATA binary\n" + bytes(two_points)},
      {"pcd",
       pcd_head + "DATA binary_compressed\n" + bytes<std::uint32_t>({25, 24}) + '\x17' + by_field},
      {"ply", ply_head + "1 2 3\n-4.5 5 6\n"},
      {"ply", replaced(ply_head, "ascii", "binary_little_endian") + bytes(two_points)}};
  std::mt19937 dice(7);
  int refused = 0, read = 0;
  for (int n = 0; n < 2000; ++n) {
    auto [extension, content] = files[n % 5];
    for (unsigned k = 1 + dice() % 3; k > 0; --k) {
      const std::size_t at = dice() % content.size();
      if (dice() % 4 == 0)
        content.erase(at, 1 + dice() % 8);
      else
        content[at] = dice() % 2 ? char(dice() % 256) : char('0' + dice() % 10);
    }
    MissionOnDisk disk;
    disk.cloud("cloud_10_000000005." + extension, content);
    disk.refusal() == "accepted" ? ++read : ++refused;
  }
  EXPECT_GT(refused, 500);
  EXPECT_GT(read, 100);
}

TEST(MissionFolder, FilesWithoutANodeAreWarnings) {
  MissionOnDisk disk;
  const std::string content = pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n";
  disk.cloud("cloud_10_000000005.pcd", content).cloud("cloud_99_000000000.pcd", content);
  disk.cloud("notes.txt", "x").cloud("cloud_10_000000005.ply", ply_head + "1 2 3\n1 2 3\n");
  const Mission m = disk.read();
  EXPECT_TRUE(contains(m.warnings, "2 files belong to no node: notes.txt cloud_99_000000000.pcd"));
  EXPECT_TRUE(contains(m.warnings, "1 files are left out"));
  EXPECT_EQ(m.nodes[0].payload->where(),
            (disk.path() / "individual_clouds/cloud_10_000000005.pcd").string());
}

TEST(MissionFolder, NodesThatShareAStampGetNoPayload) {
  MissionOnDisk disk;
  write_file(
      disk.path() / "slam_pose_graph.g2o",
      "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 10 5\nVERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 10 5\n"
      "VERTEX_SE3:QUAT_TIME 2 2 0 0 0 0 0 1 11 0\n");
  const std::string content = pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n";
  disk.cloud("cloud_10_000000005.pcd", content).cloud("cloud_11_000000000.pcd", content);
  const Mission m = disk.read();
  EXPECT_FALSE(m.nodes[0].payload);
  EXPECT_FALSE(m.nodes[1].payload);
  EXPECT_TRUE(m.nodes[2].payload);
  EXPECT_TRUE(contains(m.warnings, "2 nodes share their stamp"));
}

TEST(MissionFolder, OtherCloudFolders) {
  MissionOnDisk disk;
  disk.cloud("cloud_10_000000005.pcd", pcd_head + "DATA ascii\n1 2 3\n-4.5 5 6\n");
  fs::rename(disk.path() / "individual_clouds", disk.path() / "payload_clouds");
  EXPECT_TRUE(disk.read().nodes[0].payload);
  EXPECT_FALSE(disk.read("{cloud_folders: [scans]}").nodes[0].payload);
}

TEST(MissionFolder, UnreadablePlaces) {
  const auto reader = testing::component<MissionReader>("mission_folder");
  const auto context = testing::make_context();
  const testing::TemporaryFolder empty;
  EXPECT_THROW(reader->read(empty.path(), *context), Error);
  EXPECT_THROW(reader->read(empty / "absent", *context), Error);
  write_file(empty / "file.txt", "x");
  EXPECT_THROW(reader->read(empty / "file.txt", *context), Error);
  EXPECT_THROW(reader->read(empty / "file.txt" / "deeper", *context), Error);
  MissionOnDisk disk;
  fs::remove_all(disk.path() / "individual_clouds");
  write_file(disk.path() / "individual_clouds", "a file in place of a folder");
  try {
    disk.read();
    FAIL() << "expected an error";
  } catch (const Error& error) {
    EXPECT_EQ(error.where(), (disk.path() / "individual_clouds").string());
  }
}

TEST(MissionFolder, BadTablesNameTheLine) {
  const auto refusal = [](const std::string& file, const std::string& content) -> std::string {
    MissionOnDisk disk;
    fs::create_directories(disk.path() / "individual_trees");
    write_file(disk.path() / file, content);
    try {
      disk.read().nodes[0].payload->load();
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  const std::string trees = "individual_trees/trees_10_000000005.csv";
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), message.npos) << message;
  };
  expect(refusal(trees, "x,y,z,dbh\n1,2,3,0.2\n1,2\n"), ".csv:3: expected 4 fields");
  expect(refusal(trees, "x,y,z,dbh\n1,2,nan,0.2\n"), ".csv:2: found z 'nan'");
  expect(refusal(trees, "x,y,z,dbh\n1,2,3,-1\n"), ".csv:2: found dbh -1");
  expect(refusal(trees, "a,b\n"), ".csv:1: found no column 'x'");
  expect(refusal(trees, ""), "found no column 'x'");
  expect(refusal(trees, "x,y,z,axis_x,axis_y,axis_z\n1,2,3,0,0,0\n"), "axis has no length");
  const std::string head = "sec,nsec,lat,lon,alt,sd_e,sd_n,sd_u\n";
  expect(refusal("gnss.csv", head + "1,0,61,25,100,1,1,0\n"), "gnss.csv:2: found sd_u 0");
  expect(refusal("gnss.csv", head + "1,0,125,25,100,1,1,1\n"), "gnss.csv:2: expected lat");
  expect(refusal("gnss.csv", "stamp,lat\n1,2\n"), "gnss.csv:1: found no column 'sec'");
  expect(refusal("gnss.csv", "sec,nsec,lat,lon,alt,sigma\n"), "found column 'sigma'");
}

TEST(MissionFolder, CovarianceColumnsAndOrderOfFixes) {
  MissionOnDisk disk;
  write_file(disk.path() / "gnss.csv",
             "sec,nsec,lat,lon,alt,cov_ee,cov_en,cov_eu,cov_nn,cov_nu,cov_uu\n"
             "12,0,61,25,100,4,1,0.5,9,0.25,16\n11,7,61,25,101,4,0,0,9,0,16\n");
  const Mission m = disk.read();
  ASSERT_EQ(m.fixes.size(), 2u);
  EXPECT_EQ(m.fixes[0].stamp, (Stamp{11, 7}));
  EXPECT_EQ(m.fixes[1].covariance, (Mat3() << 4, 1, 0.5, 1, 9, 0.25, 0.5, 0.25, 16).finished());
}

/// A LAS file of version 1.2, point format 0, with these points in centimetres.
std::string las_file(const std::vector<std::array<std::int32_t, 3>>& points) {
  std::string out(227, '\0');
  const auto put = [&](std::size_t at, auto value) {
    std::memcpy(out.data() + at, &value, sizeof value);
  };
  out.replace(0, 4, "LASF");
  out[24] = 1, out[25] = 2;
  put(94, std::uint16_t(227));
  put(96, std::uint32_t(227));
  put(105, std::uint16_t(20));
  put(107, std::uint32_t(points.size()));
  for (std::size_t k = 0; k < 3; ++k) put(131 + 8 * k, 0.01), put(155 + 8 * k, 100.0);
  for (const auto& p : points) {
    out.resize(out.size() + 20, '\0');
    std::memcpy(out.data() + out.size() - 20, p.data(), 12);
    out[out.size() - 8] = 42;
  }
  return out;
}

TEST(MissionFolder, LasClouds) {
  MissionOnDisk disk;
  disk.cloud("cloud_10_000000005.las", las_file({{-9900, -10050, 25}, {0, 1, 2}}));
  const auto cloud = disk.read().nodes[0].payload->load().cloud;
  ASSERT_EQ(cloud->size(), 2u);
  EXPECT_EQ(cloud->xyz, (std::vector<float>{1, -0.5, 100.25, 100, 100.01f, 100.02f}));
  EXPECT_EQ(cloud->intensity, (std::vector<float>{42, 42}));
}

TEST(MissionFolder, BadLasCloudsSayWhatIsWrong) {
  const auto refusal = [](std::string content) -> std::string {
    MissionOnDisk disk;
    disk.cloud("cloud_10_000000005.las", content);
    try {
      disk.read().nodes[0].payload->load();
    } catch (const Error& error) {
      return error.what();
    }
    return "accepted";
  };
  const auto expect = [&](const std::string& content, const std::string& part) {
    const std::string message = refusal(content);
    EXPECT_NE(message.find("cloud_10_000000005.las"), message.npos) << message;
    EXPECT_NE(message.find(part), message.npos) << message;
  };
  const std::string good = las_file({{1, 2, 3}, {4, 5, 6}});
  const auto with = [&](std::size_t at, auto value) {
    std::string out = good;
    std::memcpy(out.data() + at, &value, sizeof value);
    return out;
  };
  expect("", "is no LAS file");
  expect(good.substr(0, 100), "is no LAS file");
  expect(good.substr(0, good.size() - 1), "promises 2 points, the file holds 1");
  expect(with(107, std::uint32_t(7)), "promises 7 points, the file holds 2");
  expect(with(96, std::uint32_t(100000)), "the file holds 0");
  expect(with(25, char(5)), "version 1.5");
  expect(with(25, char(4)), "ends within its header");
  expect(with(104, char(0x80)), "compressed (LAZ)");
  expect(with(104, char(11)), "point format 11");
  expect(with(104, char(1)), "expected 28 or more");
  expect(with(131, 0.0), "scale");
  expect(with(155, 6.8e6), "base frame");
}

/// `$`, the text, `*` and its checksum.
std::string nmea(const std::string& text) {
  unsigned sum = 0;
  for (const char c : text) sum ^= unsigned(static_cast<unsigned char>(c));
  char end[8];
  std::snprintf(end, sizeof end, "*%02X\r\n", sum);
  return "$" + text + end;
}

/// The mission has no clouds, and warns of that; these are the others.
std::vector<std::string> gnss_warnings(const Mission& mission) {
  std::vector<std::string> out;
  for (const std::string& warning : mission.warnings)
    if (warning.find("/gnss.") != std::string::npos) out.push_back(warning);
  return out;
}

Mission with_log(const std::string& log) {
  MissionOnDisk disk;
  write_file(disk.path() / "gnss.nmea", log);
  return disk.read();
}

// The sentences that every description of the format shows.
TEST(MissionFolder, NmeaSentencesBecomeFixes) {
  const Mission m =
      with_log("$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\n"
               "$GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W*6A\n");
  EXPECT_TRUE(gnss_warnings(m).empty());
  ASSERT_EQ(m.fixes.size(), 1u);
  EXPECT_EQ(m.fixes[0].stamp, (Stamp{764426119, 0}));
  EXPECT_NEAR(m.fixes[0].latitude, 48 + 7.038 / 60, 1e-12);
  EXPECT_NEAR(m.fixes[0].longitude, 11 + 31.0 / 60, 1e-12);
  EXPECT_NEAR(m.fixes[0].altitude, 545.4 + 46.9, 1e-12);  // above the ellipsoid
  EXPECT_NEAR(m.fixes[0].covariance(0, 0), 2.7 * 2.7, 1e-12);
}

TEST(MissionFolder, NmeaOverMidnightAndSouthWest) {
  const Mission m = with_log(
      nmea("GNGGA,235959.75,3330.0,S,07030.0,W,4,20,0.5,10,M,-3.5,M,,") +
      nmea("GNGST,235959.75,,,,,0.02,0.01,0.04") +
      nmea("GNGGA,000000.25,3330.0,S,07030.0,W,4,20,0.5,10,M,-3.5,M,,") +
      "2026-03-01 " + nmea("GNRMC,000000.25,A,3330.0,S,07030.0,W,0,0,010326,,"));
  ASSERT_EQ(m.fixes.size(), 2u);
  EXPECT_EQ(m.fixes[0].stamp, (Stamp{1772323199, 750'000'000}));
  EXPECT_EQ(m.fixes[1].stamp, (Stamp{1772323200, 250'000'000}));
  EXPECT_EQ(m.fixes[0].latitude, -33.5);
  EXPECT_EQ(m.fixes[0].longitude, -70.5);
  EXPECT_EQ(m.fixes[0].altitude, 6.5);
  EXPECT_NEAR(m.fixes[0].covariance(0, 0), 1e-4, 1e-15);  // east is the second of GST
}

TEST(MissionFolder, NmeaSaysWhatItLeavesOut) {
  const std::string date = nmea("GPRMC,120000,A,6100.0,N,02500.0,E,0,0,010326,,");
  const std::string good = nmea("GPGGA,120001,6100.0,N,02500.0,E,1,8,1,150,M,18,M,,");
  std::string damaged = good;
  damaged[20] = '7';
  const Mission m = with_log(date + good + damaged +
                             nmea("GPGGA,120002,,,,,0,0,,,M,,M,,") +
                             nmea("GPGGA,120003,6100.0,N,02500.0,E,1,8,1,150,M,,M,,") + "noise\n");
  ASSERT_EQ(m.fixes.size(), 2u);
  EXPECT_EQ(m.fixes[0].altitude, 168);
  EXPECT_GT(m.fixes[1].covariance(2, 2), 3600);
  const auto warnings = gnss_warnings(m);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("gnss.nmea:3: 1 sentences whose checksum"), std::string::npos);
  EXPECT_NE(warnings[1].find("gnss.nmea:4: 1 GGA sentences tell no place"), std::string::npos);
  EXPECT_NE(warnings[2].find("gnss.nmea:5: 1 GGA sentences have no geoid"), std::string::npos);
  EXPECT_THROW(with_log(good), Error);  // no date
}

TEST(MissionFolder, QualityInPlaceOfSigmas) {
  MissionOnDisk disk;
  write_file(disk.path() / "gnss.csv",
             "sec,nsec,lat,lon,alt,quality\n10,0,61,25,100,4\n11,0,61,25,100,0\n");
  const Mission m = disk.read();
  ASSERT_EQ(m.fixes.size(), 1u);
  EXPECT_NEAR(m.fixes[0].covariance(0, 0), 4e-4, 1e-15);
  EXPECT_EQ(gnss_warnings(m).size(), 1u);
  write_file(disk.path() / "gnss.csv", "sec,nsec,lat,lon,alt,quality\n10,0,61,25,100,9\n");
  EXPECT_NE(disk.refusal().find("gnss.csv:2: found quality 9"), std::string::npos);
}

/// The block ```name of docs/formats.md.
std::string example(const std::string& name) {
  const std::string text = read_file(testing::source("docs/formats.md"));
  const std::string fence = "```" + name + "\n";
  const auto begin = text.find(fence) + fence.size();
  return text.substr(begin, text.find("```", begin) - begin);
}

TEST(MissionFolder, TheExampleOfTheDocumentationIsAMission) {
  const testing::TemporaryFolder folder;
  fs::create_directories(folder / "individual_trees");
  write_file(folder / "slam_pose_graph.slam", example("g2o"));
  for (const char* stamp : {"1683269382_051793003", "1683269384_652873039"})
    write_file(folder / "individual_trees" / (std::string("trees_") + stamp + ".csv"),
               example("trees"));
  write_file(folder / "gnss.csv", example("gnss"));
  const Mission m = testing::component<MissionReader>("mission_folder")
                        ->read(folder.path(), *testing::make_context());
  EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
  EXPECT_EQ(m.nodes.size(), 2u);
  EXPECT_EQ(m.edges.size(), 1u);
  EXPECT_TRUE(m.georeference && m.nodes[0].fixed);
  const auto trees = m.nodes[1].payload->load().trees;
  ASSERT_EQ(trees->size(), 2u);
  EXPECT_TRUE(std::isnan((*trees)[1].dbh));
  EXPECT_EQ((*trees)[0].dbh, 0.165);
  EXPECT_NEAR((*trees)[0].axis.norm(), 1, 1e-12);
  EXPECT_TRUE((*trees)[0].reconstructed && !(*trees)[1].reconstructed);
  ASSERT_EQ(m.fixes.size(), 1u);
  EXPECT_EQ(m.fixes[0].covariance(2, 2), 36);
}

TEST(MissionFolder, RealMissionsHaveNothingToWarnOf) {
  const auto reader = testing::component<MissionReader>("mission_folder", "{check_payloads: true}");
  for (const char* archive : {"missions_newer_college", "missions_evo"}) {
    const auto data = testing::real_data(archive);
    if (data.empty()) GTEST_SKIP() << archive << " is not there";
    int missions = 0;
    for (const auto& entry : fs::recursive_directory_iterator(data)) {
      if (!fs::exists(entry.path() / "slam_pose_graph.g2o")) continue;
      const Mission m = reader->read(entry.path(), *testing::make_context(2));
      EXPECT_TRUE(m.warnings.empty()) << m.warnings[0];
      for (const Node& node : m.nodes) ASSERT_TRUE(node.payload);
      ++missions;
    }
    EXPECT_GE(missions, 2);
  }
}

}  // namespace
}  // namespace cambium
