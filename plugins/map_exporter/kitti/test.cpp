// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "cambium/files.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

TEST(KittiExporter, WritesRowsOfTheMatrix) {
  const TemporaryFolder folder;
  Mission a = make_mission("a", {SE3{}, SE3{Quat(0, 0, 0, 1), Vec3(1.5, 2, 3)}});
  a.nodes[1].stamp = Stamp{1583840261, 39995392};
  const auto files =
      component<MapExporter>("kitti")->write(make_atlas({a}), folder.path(), *make_context());
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(read_file(folder / "a.kitti"),
            "1 0 0 0 0 1 0 0 0 0 1 0\n-1 0 0 1.5 0 -1 0 2 0 0 1 3\n");
  EXPECT_EQ(read_file(folder / "a.times"), "0.000000000\n1583840261.039995392\n");
}

TEST(KittiExporter, NoStampsNoTimes) {
  const TemporaryFolder folder;
  Mission a = make_mission("a", {SE3{}, SE3{}});
  a.nodes[0].stamp.reset();
  EXPECT_EQ(component<MapExporter>("kitti")
                ->write(make_atlas({a}), folder.path(), *make_context())
                .size(),
            1u);
}

}  // namespace
}  // namespace cambium::testing
