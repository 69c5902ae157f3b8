// SPDX-License-Identifier: BSD-3-Clause
// The tables of a simulated detector against those of a real one: every fourth node of the first of
// three missions at Evo.
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

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + std::ptrdiff_t(v.size() / 2), v.end());
  return v[v.size() / 2];
}

TEST(TreeTable, CountsAreThoseOfRealTables) {
  double all = 0, reconstructed = 0;
  for (const TreeTable& t : tables())
    for (const Tree& tree : t.trees) all++, reconstructed += tree.reconstructed;
  EXPECT_NEAR(all / 49, 105, 12);
  EXPECT_NEAR(reconstructed / 49, 52, 8);
}

TEST(TreeTable, DistancesAndScoresAreThoseOfRealTables) {
  std::vector<double> nearest, range, far, good, bad;
  for (const TreeTable& t : tables())
    for (const Tree& a : t.trees) {
      (a.reconstructed ? good : bad).push_back(a.score);
      (a.reconstructed ? range : far).push_back(a.base.head<2>().norm());
      if (!a.reconstructed) continue;
      double best = 1e9;
      for (const Tree& b : t.trees)
        if (&a != &b && b.reconstructed) best = std::min(best, (a.base - b.base).head<2>().norm());
      nearest.push_back(best);
    }
  EXPECT_NEAR(median(nearest), 3.5, 0.7);  // real: 3.6
  EXPECT_NEAR(median(range), 16.4, 2.0);   // real: 16.4
  EXPECT_NEAR(median(far), 14.6, 2.5);     // real: 14.6
  EXPECT_NEAR(median(good), 0.93, 0.03);
  EXPECT_NEAR(median(bad), 0.32, 0.05);
}

TEST(TreeTable, ReconstructedStemsAreFoundAgainTheOthersLessOften) {
  double again[2] = {0, 0}, of[2] = {0, 0}, error = 0;
  for (int i = 0; i < 40; ++i) {
    const double x = -40 + 2.0 * i;
    const SE3 T_world_a = pose_at(x, 0), T_world_b = pose_at(x + 1.5, 0);
    const auto a = table_at(x, 0, std::uint64_t(2 * i)).trees;
    const auto b = table_at(x + 1.5, 0, std::uint64_t(2 * i + 1)).trees;
    for (const Tree& tree : a) {
      const Vec3 p = T_world_a * tree.base;
      if (tree.base.head<2>().norm() > 20) continue;
      double best = 1e9;
      for (const Tree& other : b)
        best = std::min(best, (T_world_b * other.base - p).head<2>().norm());
      of[tree.reconstructed]++;
      again[tree.reconstructed] += best < 0.5;
      if (tree.reconstructed && best < 0.5) error += best;
    }
  }
  EXPECT_GT(again[1] / of[1], 0.94);          // real: 0.95 to 0.99
  EXPECT_NEAR(again[0] / of[0], 0.72, 0.15);  // real: 0.87 after 1.5 m, 0.64 after 29 m
  EXPECT_NEAR(error / again[1], 0.04, 0.02);  // real: median 0.032
}

TEST(TreeTable, AboutHalfOfTheOtherDetectionsAreNoTree) {
  double no_tree = 0, others = 0;
  for (int i = 0; i < 49; ++i) {
    const double x = -42.0 + 14 * (i % 7), y = -42.0 + 14 * (i / 7);
    const TreeTable t = table_at(x, y, std::uint64_t(i));
    for (const Tree& tree : t.trees) others += !tree.reconstructed;
    no_tree += double(t.trees.size()) - double(t.stems.size());
  }
  EXPECT_NEAR(no_tree / others, 0.5, 0.15);
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
