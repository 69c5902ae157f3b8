// SPDX-License-Identifier: BSD-3-Clause
// Many missions: their order, islands, copies, and what is done with a finished run.
#include <algorithm>
#include <cstdio>
#include <sstream>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class Fleet : public ::testing::Test {
 protected:
  void SetUp() override {
    for (int k = 0; k < 3; ++k) {
      std::vector<SE3> poses;
      for (int i = 0; i < 8; ++i) poses.push_back(SE3::from_yaw(0.1 * i, {2.0 * i, 0.3 * k, 0}));
      Mission mission = make_mission(std::string(1, char('a' + k)), poses);
      for (Node& node : mission.nodes) node.stamp->sec += 1000 * (k + 1);
      // A loop that does not fit, so that the optimisation moves something.
      Edge loop = mission.edges.back();
      loop.kind = EdgeKind::loop;
      loop.tail = 0;
      loop.head = 7;
      loop.T_tail_head = poses[7] * SE3::from_yaw(0.05, {0.2, 0.1, 0});
      mission.edges.push_back(loop);
      write(mission, path(mission.name));
    }
    write_file(path("p.yaml"), "version: 1\nsteps: [{optimize: sparse_lm}]\n");
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  static void write(const Mission& mission, const fs::path& folder) {
    fs::create_directories(folder);
    AtomicFile file(folder / "slam_pose_graph.g2o");
    write_g2o(file.stream(), mission);
    file.commit();
  }
  Outcome run(std::vector<std::string> missions, const std::string& out) const {
    std::vector<std::string> arguments{"run", path("p.yaml"), "--out", path(out)};
    for (const auto& m : missions) arguments.push_back(path(m));
    return run_cambium(arguments);
  }
  std::string text(const std::string& file) const { return read_file(path(file)); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_F(Fleet, TheOrderOfMissionsDoesNotShowAndIslandsAreWarnings) {
  const Outcome first = run({"a", "b", "c"}, "abc");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_CONTAINS(first.err, "3 islands: no accepted loop ties them together: {a} {b} {c}");
  std::vector<std::string> order{"a", "b", "c"};
  while (std::next_permutation(order.begin(), order.end())) {
    ASSERT_EQ(run(order, "other").code, 0);
    for (const char* file : {"fused.g2o", "fused_island_1.g2o", "fused_island_2.g2o", "a.tum",
                             "b.tum", "c.tum", "ledger.jsonl"})
      EXPECT_EQ(text(std::string("abc/") + file), text(std::string("other/") + file)) << file;
  }
}

TEST_F(Fleet, CopiesAndNamesUsedTwiceAreRefused) {
  fs::copy(path("a"), path("copy_of_a"), fs::copy_options::recursive);
  const Outcome copy = run({"a", "b", "copy_of_a"}, "out");
  EXPECT_EQ(copy.code, 4);
  EXPECT_CONTAINS(copy.err, "'a' and 'copy_of_a' are the same recording");
  fs::create_directories(path("elsewhere"));
  fs::copy(path("b"), path("elsewhere/a"), fs::copy_options::recursive);
  const Outcome name = run({"a", "elsewhere/a"}, "out");
  EXPECT_EQ(name.code, 4);
  EXPECT_CONTAINS(name.err, "the mission name 'a' is used twice");
}

TEST_F(Fleet, ARunFolderStandsForItsMissions) {
  ASSERT_EQ(run({"a", "b"}, "ab").code, 0);
  ASSERT_EQ(run({"ab", "c"}, "grown").code, 0);
  ASSERT_EQ(run({"a", "b", "c"}, "abc").code, 0);
  for (const char* file : {"fused.g2o", "fused_island_1.g2o", "fused_island_2.g2o"})
    EXPECT_EQ(text(std::string("grown/") + file), text(std::string("abc/") + file)) << file;
  // A mission of two runs stays once.
  ASSERT_EQ(run({"b", "c"}, "bc").code, 0);
  EXPECT_EQ(run({"ab", "bc"}, "both").code, 0);
}

TEST_F(Fleet, SplitWritesMissionsThatReadBack) {
  ASSERT_EQ(run({"a", "b"}, "ab").code, 0);
  const Outcome split = run_cambium({"split", path("ab"), "--out", path("updated")});
  ASSERT_EQ(split.code, 0) << split.err;
  const Mission before = read_g2o(path("a/slam_pose_graph.g2o")),
                after = read_g2o(path("updated/a/slam_pose_graph.g2o")),
                fused = read_g2o(path("ab/fused.g2o"));
  ASSERT_EQ(after.nodes.size(), before.nodes.size());
  EXPECT_GT((after.nodes[7].T_mission_node.t - before.nodes[7].T_mission_node.t).norm(), 0.01);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(after.nodes[i].id, before.nodes[i].id);
    EXPECT_EQ(after.nodes[i].T_mission_node.t, fused.nodes[i].T_mission_node.t);
    EXPECT_EQ(after.nodes[i].stamp, before.nodes[i].stamp);
  }
  EXPECT_EQ(after.edges.size(), before.edges.size());
  EXPECT_EQ(run({"updated/a", "updated/b"}, "again").code, 0);
  EXPECT_EQ(run_cambium({"split", path("a"), "--out", path("none")}).code, 2);
}

TEST_F(Fleet, PosesAtOtherStamps) {
  ASSERT_EQ(run({"a", "b"}, "ab").code, 0);
  write_file(path("times.csv"), "1002,0\n2003.5\n9999\n");
  const Outcome outcome =
      run_cambium({"poses", path("ab"), "--at", path("times.csv"), "--out", path("poses.csv")});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_CONTAINS(outcome.err, "1 of 3 stamps lie on no mission's path");
  const Mission a = read_g2o(path("ab/fused.g2o"));
  const std::string csv = text("poses.csv");
  EXPECT_CONTAINS(csv, "\na,1002,0," + format_number(a.nodes[2].T_mission_node.t.x()) + ",");
  EXPECT_CONTAINS(csv, "\nb,2003,500000000,");
  EXPECT_EQ(run_cambium({"poses", path("ab"), "--at", path("times.csv"), "--mission", "z"}).code,
            2);
}

// Between two nodes the robot went round something, and only its odometry knows.
TEST_F(Fleet, PosesBetweenNodesFollowTheOdometryOfTheMissionsFolder) {
  ASSERT_EQ(run({"a", "b"}, "ab").code, 0);
  write_file(path("times.csv"), "1002\n1002.5\n1003\n");
  const auto poses = [&](const std::string& name) {
    EXPECT_EQ(run_cambium({"poses", path("ab"), "--at", path("times.csv"), "--mission", "a",
                           "--out", path(name)})
                  .code,
              0);
    std::vector<Vec3> out;
    std::istringstream lines(text(name));
    std::string line;
    for (std::getline(lines, line); std::getline(lines, line);) {
      Vec3 t;
      long long sec = 0, nsec = 0;
      EXPECT_EQ(
          std::sscanf(line.c_str(), "a,%lld,%lld,%lf,%lf,%lf", &sec, &nsec, &t[0], &t[1], &t[2]), 5)
          << line;
      out.push_back(t);
    }
    return out;
  };
  const auto straight = poses("without.csv");
  const Mission a = read_g2o(path("a/slam_pose_graph.g2o"));
  std::vector<StampedPose> odometry;
  for (int half = 0; half < 8; ++half) {  // in another frame, half a second apart
    SE3 T =
        interpolate(a.nodes[half / 2].T_mission_node, a.nodes[(half + 1) / 2].T_mission_node, 0.5);
    if (half == 5) T = T * SE3::from_yaw(0, {0, 0.7, 0});
    odometry.push_back(
        {{1000 + half / 2, half % 2 * 500'000'000}, SE3::from_yaw(1, {9, 9, 9}) * T});
  }
  write_file(path("a/odometry.tum"), format_tum(odometry));
  const auto round = poses("with.csv");
  ASSERT_EQ(straight.size(), 3u);
  ASSERT_EQ(round.size(), 3u);
  EXPECT_LT((round[0] - straight[0]).norm(), 1e-9);
  EXPECT_NEAR((round[1] - straight[1]).norm(), 0.7, 0.02);
  EXPECT_LT((round[2] - straight[2]).norm(), 1e-9);
}
