// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

class Trajectory : public ::testing::Test {
 protected:
  Mission read(const std::string& name, const std::string& text, const std::string& yaml = "{}") {
    write_file(folder_ / name, text);
    return component<MissionReader>("trajectory", yaml)->read(folder_ / name, *make_context());
  }
  std::string refusal(const std::string& name, const std::string& text) {
    try {
      read(name, text);
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::data);
      return e.what();
    }
    return "accepted";
  }
  TemporaryFolder folder_;
};

TEST_F(Trajectory, TumKeepsNanoseconds) {
  const Mission m = read("a.tum",
                         "# t x y z qx qy qz qw\n1583840261.039995392 1 2 3 0 0 0 1\n"
                         "1583840262.5 4 2 3 0 0 1 0\n");
  ASSERT_EQ(m.nodes.size(), 2u);
  EXPECT_EQ(m.name, "a");
  EXPECT_EQ(m.nodes[0].stamp, (Stamp{1583840261, 39995392}));
  ASSERT_EQ(m.edges.size(), 1u);
  EXPECT_NEAR((m.edges[0].T_tail_head.t - Vec3(3, 0, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR(m.edges[0].information(0, 0), 400, 1e-9);
}

// Ten metres straight ahead for a camera: ahead is x of the base; a turn to the right is one about
// -z.
TEST_F(Trajectory, KittiCamerasLookAlongX) {
  write_file(folder_ / "times.txt", "0.0\n1.036e-01\n");
  const Mission m = read("00.kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 1 2 0 1 0 -3 -1 0 0 10\n");
  ASSERT_EQ(m.nodes.size(), 2u);
  EXPECT_EQ(m.nodes[1].stamp, (Stamp{0, 103600000}));
  EXPECT_LT((m.nodes[1].T_mission_node.t - Vec3(10, -2, 3)).norm(), 1e-12);
  EXPECT_NEAR(m.nodes[1].T_mission_node.yaw(), -M_PI / 2, 1e-9);
  const Mission vehicle = read("00.kitti", "1 0 0 7 0 1 0 8 0 0 1 9\n1 0 0 7 0 1 0 8 0 0 1 9\n",
                               "{camera_frame: false}");
  EXPECT_EQ(vehicle.nodes[0].T_mission_node.t, Vec3(7, 8, 9));
}

TEST_F(Trajectory, MistakesNameTheLine) {
  const auto expect = [&](const std::string& name, const std::string& text,
                          const std::string& part) {
    const std::string message = refusal(name, text);
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect("a.tum", "", "has no pose");
  expect("a.tum", "1 2 3\n", "a.tum:1");
  expect("a.kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n\n1 0 0 0\n", "a.kitti:3: expected 12 numbers");
  expect("a.kitti", "1 0 0 0 0 1 0 0 0 0 1 nan\n", "a.kitti:1: found 'nan'");
  expect("a.kitti", "1 0 0 0 0 1 0 0 0 0 -1 0\n", "no rotation");
  write_file(folder_ / "b.times", "1\n2\n");
  expect("b.kitti", "1 0 0 0 0 1 0 0 0 0 1 0\n", "holds 2 stamps");
}

// What the exporters write reads back.
TEST_F(Trajectory, ReadsWhatCambiumWrites) {
  std::vector<SE3> poses;
  for (int i = 0; i < 5; ++i)
    poses.push_back(SE3::exp((Vec6() << 0.3 * i, 1, 2 * i, 0.1 * i, 0.2, 0.3).finished()));
  const Atlas atlas = make_atlas({make_mission("a", poses)});
  for (const auto& [exporter, extension] :
       std::vector<std::pair<std::string, std::string>>{{"tum", ".tum"}, {"kitti", ".kitti"}}) {
    const auto files =
        component<MapExporter>(exporter)->write(atlas, folder_.path(), *make_context());
    const auto reader = component<MissionReader>("trajectory", "{camera_frame: false}");
    ASSERT_TRUE(reader->accepts(folder_ / ("a" + extension)));
    const Mission m = reader->read(folder_ / ("a" + extension), *make_context());
    ASSERT_EQ(m.nodes.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
      EXPECT_LT((poses[i].inverse() * m.nodes[i].T_mission_node).log().norm(), 1e-9);
      EXPECT_EQ(m.nodes[i].stamp, (Stamp{std::int64_t(i), 0}));
    }
  }
}

}  // namespace
}  // namespace cambium::testing
