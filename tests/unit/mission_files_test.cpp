// SPDX-License-Identifier: BSD-3-Clause
// What is written as a mission folder reads back as the same mission.
#include "engine/mission_files.hpp"

#include "cambium/files.hpp"
#include "support/plain_context.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

namespace fs = std::filesystem;

Mission full_mission() {
  Mission mission =
      make_mission("a", {SE3(), SE3::exp((Vec6() << 1, 2, 3, 0.1, 0.2, 0.3).finished())});
  for (std::size_t i = 0; i < 2; ++i) mission.nodes[i].stamp = Stamp{100 + std::int64_t(i), 5};
  mission.nodes[0].payload =
      in_memory(Cloud{{1, 2, 3, 4, 5, 6}, {0, 0, 1, 1, 0, 0}, {7, 8}, {2, 64}});
  Mat3 covariance = Mat3::Identity() * 4;
  covariance(0, 1) = covariance(1, 0) = 0.125;
  mission.fixes = {{{100, 0}, 61.5, 25.25, 130, covariance}};
  return mission;
}

Mission read(const fs::path& folder) {
  return component<MissionReader>("mission_folder", "{}")->read(folder, *make_context());
}

class MissionFiles : public ::testing::Test {
 protected:
  TemporaryFolder folder_;
  Progress progress_{Progress::Style::quiet};
  Engine engine_{EngineOptions{}, progress_};
};

TEST_F(MissionFiles, ReadBackAsTheSameMission) {
  const Mission mission = full_mission();
  const WrittenMission written = write_mission(mission, folder_.path(), engine_);
  EXPECT_EQ(written.clouds, 1u);
  EXPECT_EQ(written.points, 2u);
  const Mission again = read(folder_.path());
  ASSERT_EQ(again.nodes.size(), 2u);
  EXPECT_EQ(again.nodes[1].stamp, mission.nodes[1].stamp);
  EXPECT_EQ(again.nodes[1].T_mission_node.t, mission.nodes[1].T_mission_node.t);
  const Payload payload = again.nodes[0].payload->load();
  const Cloud given = *mission.nodes[0].payload->load().cloud;
  EXPECT_EQ(payload.cloud->xyz, given.xyz);
  EXPECT_EQ(payload.cloud->normals, given.normals);
  EXPECT_EQ(payload.cloud->intensity, given.intensity);
  EXPECT_EQ(payload.cloud->label, given.label);
  ASSERT_EQ(again.fixes.size(), 1u);
  EXPECT_EQ(again.fixes[0].covariance, mission.fixes[0].covariance);
}

// A payload of two pictures, as a stereo camera takes, and an inertial measurement.
struct Pictures final : PayloadSource {
  explicit Pictures(fs::path folder) : folder_(std::move(folder)) {}
  Payload load() const override {
    Payload out;
    out.images = std::make_shared<const std::vector<Image>>(
        std::vector<Image>{{folder_ / "left.png", "cam0"}, {folder_ / "right.png", "cam1"}});
    out.imu = std::make_shared<const std::vector<ImuSample>>(1);
    return out;
  }
  Digest digest() const override { return {}; }
  std::string where() const override { return folder_.string(); }
  fs::path folder_;
};

TEST_F(MissionFiles, ThePictureOfANodeIsCopiedAndTheRestCounted) {
  write_file(folder_ / "left.png", "left");
  write_file(folder_ / "right.png", "right");
  Mission mission = full_mission();
  mission.nodes[0].payload = std::make_shared<Pictures>(folder_.path());
  fs::create_directory(folder_ / "mission");
  const WrittenMission written = write_mission(mission, folder_ / "mission", engine_);
  EXPECT_EQ(written.pictures, 1u);
  EXPECT_EQ(written.other_pictures, 1u);
  EXPECT_EQ(written.inertial, 1u);
  const Payload payload = read(folder_ / "mission").nodes[0].payload->load();
  ASSERT_TRUE(payload.images);
  EXPECT_EQ(read_file(payload.images->front().file), "left");
}

TEST_F(MissionFiles, APayloadWithoutAStampHasNoName) {
  Mission mission = full_mission();
  mission.nodes[0].stamp.reset();
  EXPECT_THROW(write_mission(mission, folder_.path(), engine_), Error);
}

TEST_F(MissionFiles, ANewFolderIsWholeOrAbsent) {
  const fs::path path = folder_ / "new";
  {
    NewFolder folder(path);
    write_file(folder.temporary() / "half", "half");
  }
  EXPECT_TRUE(fs::is_empty(folder_.path()));
  NewFolder folder(path / "");
  write_file(folder.temporary() / "whole", "whole");
  EXPECT_FALSE(fs::exists(path));
  folder.commit();
  EXPECT_EQ(read_file(path / "whole"), "whole");
  EXPECT_THROW(NewFolder{path}, Error);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), {}), 1);
}

}  // namespace
}  // namespace cambium::testing
