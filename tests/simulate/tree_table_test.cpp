// SPDX-License-Identifier: BSD-3-Clause
// The tables of a simulated detector against those of the real one: three missions at Evo, every
// fourth node of the first one. The bounds are what separates real missions from each other.
#include "simulate/tree_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "simulate/angles.hpp"

namespace cambium::simulate {
namespace {

struct Forest {
  Terrain terrain;
  std::vector<Stem> stems, clutter;
};
const Forest& forest() {
  static const Forest f = [] {
    StandSpec stand;
    stand.size = {160, 160};
    Forest out;
    out.terrain = make_terrain({}, stand.size, 6);
    out.stems = plant(stand, out.terrain, 6);
    out.clutter = scatter_clutter({}, stand, out.terrain, 6);
    return out;
  }();
  return f;
}

SE3 pose_at(double x, double y) {
  return {attitude(0.3 * x, 0.02, -0.03), Vec3(x, y, forest().terrain.height(x, y) + 1.6)};
}
TreeTable table_at(double x, double y, std::uint64_t node, const TreesSpec& spec = {}) {
  const Forest& f = forest();
  return detect(spec, pose_at(x, y), f.stems, f.clutter, f.terrain, Random(1, "test", node));
}

std::vector<TreeTable> tables() {
  std::vector<TreeTable> out;
  for (int i = 0; i < 49; ++i)
    out.push_back(table_at(-42.0 + 14 * (i % 7), -42.0 + 14 * (i / 7), std::uint64_t(i)));
  return out;
}





TEST(TreeTable, AboutHalfOfTheOtherDetectionsAreNoTree) {
  double no_tree = 0, others = 0;
  for (int i = 0; i < 49; ++i) {
    const double x = -42.0 + 14 * (i % 7), y = -42.0 + 14 * (i / 7);
    const TreeTable t = table_at(x, y, std::uint64_t(i));
    for (const Tree& tree : t.trees) others += !tree.reconstructed;
    no_tree += double(t.trees.size()) - double(t.stems.size());
  }
  EXPECT_NEAR(no_tree / others, 0.6, 0.2);
}

TEST(TreeTable, NothingBeyondTheRangeAndAxesPointUp) {
  for (const TreeTable& t : tables()) {
    EXPECT_TRUE(std::is_sorted(t.stems.begin(), t.stems.end()));
    for (const Tree& tree : t.trees) {
      EXPECT_LT(tree.base.head<2>().norm(), 32 + 1);
      EXPECT_NEAR(tree.axis.norm(), 1, 1e-9);
      EXPECT_GT(tree.axis.z(), 0.5);
      EXPECT_GE(tree.score, 0);
      EXPECT_LE(tree.score, 1);
    }
  }
}

TEST(TreeTable, WithoutSpuriousOnesAndClutterEveryRowIsAStem) {
  TreesSpec spec;
  spec.spurious = 0;
  const Forest& f = forest();
  const TreeTable t = detect(spec, pose_at(0, 0), f.stems, {}, f.terrain, Random(1, "test"));
  EXPECT_EQ(t.trees.size(), t.stems.size());
  EXPECT_EQ(std::set(t.stems.begin(), t.stems.end()).size(), t.stems.size());
}

}  // namespace
}  // namespace cambium::simulate
