// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;

/// A recording of three seconds: a pose every half second, a picture every second, an IMU at 4 Hz.
class EurocReader : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string poses =
        "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x "
        "[], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1]\n";
    for (int i = 0; i <= 6; ++i)
      poses += stamp(500'000'000L * i) + "," + std::to_string(0.4 * i) + ",1,2,0,0,0,1,0.8\n";
    put("state_groundtruth_estimate0/data.csv", poses);
    std::string imu = "#timestamp [ns],w_x,w_y,w_z,a_x,a_y,a_z\n";
    for (int i = 0; i <= 12; ++i)
      imu += stamp(250'000'000L * i) + ",0.1,0.2," + std::to_string(i) + ",9.81,0,0.5\n";
    put("imu0/data.csv", imu);
    std::string frames = "#timestamp [ns],filename\r\n";
    for (int i = 0; i <= 3; ++i) {
      const std::string time = stamp(1'000'000'000L * i + 20'000'000);
      frames += time + "," + time + ".png\r\n";
      put("cam0/data/" + time + ".png", "picture " + std::to_string(i));
    }
    put("cam0/data.csv", frames);
  }
  static std::string stamp(long after) { return std::to_string(1403636579763555584L + after); }
  void put(const std::string& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    write_file(root_ / name, text);
  }
  Mission read(const std::string& yaml = "{}") const {
    const auto reader = component<MissionReader>("euroc", yaml);
    EXPECT_TRUE(reader->accepts(folder_ / "MH_01"));
    return reader->read(folder_ / "MH_01", *make_context());
  }
  std::string refusal() const {
    try {
      read();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::data);
      return e.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
  fs::path root_ = folder_ / "MH_01/mav0";
};

TEST_F(EurocReader, PosesBecomeNodesAfterSomeWay) {
  const Mission m = read();
  EXPECT_EQ(m.name, "MH_01");
  EXPECT_TRUE(m.warnings.empty());
  ASSERT_EQ(m.nodes.size(), 4u);  // every 0.8 m: the second pose is 0.4 m away
  EXPECT_EQ(m.nodes[1].stamp, (Stamp{1403636580, 763555584}));
  EXPECT_LT((m.nodes[1].T_mission_node.t - Vec3(0.8, 1, 2)).norm(), 1e-12);
  EXPECT_NEAR(m.nodes[1].T_mission_node.q.z(), 1, 1e-12);  // w stands first in the file
  ASSERT_EQ(m.edges.size(), 3u);
  EXPECT_LT((m.edges[0].T_tail_head.t - Vec3(-0.8, 0, 0)).norm(), 1e-12);
  EXPECT_EQ(read("{spacing: 0}").nodes.size(), 7u);
}

TEST_F(EurocReader, PicturesAndSamplesAreThePayload) {
  const Mission m = read();
  for (std::size_t n = 0; n < 4; ++n) {
    const Payload p = m.nodes[n].payload->load();
    EXPECT_FALSE(p.cloud || p.trees);
    ASSERT_TRUE(p.images && p.imu);
    ASSERT_EQ(p.images->size(), 1u);
    EXPECT_EQ(p.images->front().camera, "cam0");
    EXPECT_EQ(read_file(p.images->front().file), "picture " + std::to_string(n));
    // From the node to the next one, a second later; the last node has what is left.
    ASSERT_EQ(p.imu->size(), n < 3 ? 4u : 1u);
    EXPECT_EQ(p.imu->front().angular_velocity, Vec3(0.1, 0.2, 4.0 * double(n)));
    EXPECT_EQ(p.imu->front().acceleration, Vec3(9.81, 0, 0.5));
    EXPECT_GT(p.bytes(), 0u);
  }
  EXPECT_FALSE(read("{max_time_difference: 0.01}").nodes[0].payload->load().images);
}

TEST_F(EurocReader, DigestsFollowTheContent) {
  const Digest before = read().nodes[2].payload->digest();
  EXPECT_EQ(before, read().nodes[2].payload->digest());
  put("cam0/data/" + stamp(2'020'000'000L) + ".png", "another");
  EXPECT_NE(before, read().nodes[2].payload->digest());
}

TEST_F(EurocReader, WhatIsNotThereIsNoPayload) {
  fs::remove_all(root_ / "cam0");
  fs::remove_all(root_ / "imu0");
  for (const Node& node : read().nodes) EXPECT_FALSE(node.payload);
}

TEST_F(EurocReader, MissingPicturesAreAWarning) {
  fs::remove(root_ / "cam0/data" / (stamp(20'000'000L) + ".png"));
  const Mission m = read();
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_NE(m.warnings[0].find("1 pictures are not in data/"), std::string::npos) << m.warnings[0];
  EXPECT_FALSE(m.nodes[0].payload->load().images);
}

TEST_F(EurocReader, MistakesNameTheLine) {
  const std::string file = "state_groundtruth_estimate0/data.csv", head = "#t,x,y,z,w,a,b,c\n";
  const auto expect = [&](const std::string& text, const std::string& part) {
    put(file, text);
    const std::string message = refusal();
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(head, "has no pose");
  expect("#t,x,y,z\n1,2,3,4\n", "expected 8 columns or more");
  expect(head + "1,0,0,0,1,0,0,0\n1,0,0,0,1,0,0,0\n", "data.csv:3: its stamp is not after");
  expect(head + "1,0,0,0,0,0,0,0\n", "data.csv:2: its quaternion");
  expect(head + "1,0,0,nan,1,0,0,0\n", "data.csv:2: found z 'nan'");
  expect(head + "1.5,0,0,0,1,0,0,0\n", "expected an integer");
  expect(head + "1,0,0,0,1,0,0\n", "expected 8 fields");
}

// Poses of a map, written by the exporter and read again, to the last bit.
TEST_F(EurocReader, ReadsWhatCambiumWrites) {
  std::vector<SE3> poses;
  for (int i = 0; i < 5; ++i)
    poses.push_back(SE3::exp((Vec6() << 0.3 * i, 1, 2 * i, 0.1 * i, 0.2, 0.3).finished()));
  Mission a = make_mission("a", poses);
  for (std::size_t i = 0; i < 5; ++i)
    a.nodes[i].stamp = Stamp{1403636579 + std::int64_t(i), 763555584};
  component<MapExporter>("euroc")->write(make_atlas({a}), folder_.path(), *make_context());
  const auto reader = component<MissionReader>("euroc", "{spacing: 0}");
  ASSERT_TRUE(reader->accepts(folder_ / "a"));
  const Mission m = reader->read(folder_ / "a", *make_context());
  EXPECT_EQ(m.name, "a");
  ASSERT_EQ(m.nodes.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(m.nodes[i].stamp, a.nodes[i].stamp);
    EXPECT_EQ(m.nodes[i].T_mission_node.t, poses[i].t);
    EXPECT_LT((m.nodes[i].T_mission_node.q.coeffs() - poses[i].q.coeffs()).norm(), 1e-15);
  }
}

}  // namespace
}  // namespace cambium::testing
