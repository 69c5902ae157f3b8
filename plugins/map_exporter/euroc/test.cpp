// SPDX-License-Identifier: BSD-3-Clause
#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

TEST(EurocExporter, WritesNanosecondsAndQuaternionsWithWFirst) {
  const TemporaryFolder folder;
  Mission a = make_mission("a", {SE3{}, SE3{Quat(0, 1, 0, 0), Vec3(1.5, -2, 3)}, SE3{}});
  a.nodes[1].stamp = Stamp{1403636579, 763555584};
  a.nodes[2].stamp.reset();
  const auto files =
      component<MapExporter>("euroc")->write(make_atlas({a}), folder.path(), *make_context());
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0], folder / "a/mav0/state_groundtruth_estimate0/data.csv");
  const std::string text = read_file(files[0]);
  EXPECT_EQ(text.substr(text.find('\n') + 1),
            "0,0,0,0,1,0,0,0\n1403636579763555584,1.5,-2,3,0,1,0,0\n");
}

TEST(EurocExporter, NoStampsNoFile) {
  const TemporaryFolder folder;
  Mission a = make_mission("a", {SE3{}});
  a.nodes[0].stamp.reset();
  EXPECT_TRUE(component<MapExporter>("euroc")
                  ->write(make_atlas({a}), folder.path(), *make_context())
                  .empty());
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cambium::testing
