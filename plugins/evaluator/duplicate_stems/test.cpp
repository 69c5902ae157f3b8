// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>

#include "support/maps.hpp"

namespace cambium::testing {
namespace {

/// Trees every 2 m on a square of 10 x 10 m, as seen from T_world_base. Detections that were not
/// reconstructed stand between them, a different one at each node.
std::vector<Tree> table(const SE3& T_world_base) {
  std::vector<Tree> trees;
  for (int i = 0; i < 36; ++i) {
    Tree tree;
    tree.base = T_world_base.inverse() * Vec3(2.0 * (i % 6), 2.0 * (i / 6), 0.1 * i);
    tree.reconstructed = true;
    trees.push_back(tree);
  }
  Tree shadow;
  shadow.base = T_world_base.inverse() * Vec3(T_world_base.t.x(), T_world_base.t.y() + 2, 0);
  trees.push_back(shadow);
  return trees;
}

Atlas square() {
  std::vector<Mission> missions;
  for (const char* name : {"a", "b"}) {
    std::vector<SE3> poses;
    for (int i = 0; i < 4; ++i)
      poses.push_back(SE3::from_yaw(0.5 * i, {3.0 * i, *name == 'a' ? 1.0 : 7.0, 1.5}));
    missions.push_back(make_mission(name, poses));
    for (Node& node : missions.back().nodes)
      node.payload = in_memory(
          Payload{nullptr, std::make_shared<const std::vector<Tree>>(table(node.T_mission_node))});
  }
  return tied(make_atlas(missions));
}

using Metrics = std::map<std::string, double>;

Metrics stems(const Atlas& atlas, const std::filesystem::path& truth = {},
              const std::string& yaml = "{}") {
  return evaluate("duplicate_stems", atlas, truth, yaml);
}

TEST(DuplicateStems, AnExactMapHasNone) {
  const Metrics m = stems(square());
  EXPECT_EQ(m.at("duplicate_stems.count"), 0);
  EXPECT_EQ(m.at("duplicate_stems.pairs"), 36);
  EXPECT_LT(m.at("duplicate_stems.rms"), 1e-9);
  EXPECT_EQ(m.count("duplicate_stems.matched"), 0u);  // no truth
}

TEST(DuplicateStems, MeasuresAKnownShift) {
  const Metrics m = stems(moved(square(), 1, SE3::from_yaw(0, {0.18, 0.24, 5})));
  EXPECT_EQ(m.at("duplicate_stems.count"), 36);
  EXPECT_NEAR(m.at("duplicate_stems.rms"), 0.3, 1e-9);  // on the plan
  const Metrics forgiving =
      stems(moved(square(), 1, SE3::from_yaw(0, {0.18, 0.24, 0})), {}, "{merge_distance: 0.31}");
  EXPECT_EQ(forgiving.at("duplicate_stems.count"), 0);
}

// Without truth a shift by half of the distance between trees shows no pair at all; the truth knows
// which trees are the same.
TEST(DuplicateStems, TheTruthSeesShiftsOfAnySize) {
  const TemporaryFolder folder;
  write_truth(square(), folder.path());
  for (const double d : {0.0, 0.3, 1.0, 2.0}) {
    const Metrics m = stems(moved(square(), 1, SE3::from_yaw(0, {d, 0, 0})), folder.path());
    EXPECT_EQ(m.at("duplicate_stems.matched"), 36);
    EXPECT_NEAR(m.at("duplicate_stems.matched.rms"), d, 1e-9);
    EXPECT_EQ(m.at("duplicate_stems.count"), d > 0.2 ? 36 : 0);
    EXPECT_EQ(m.at("duplicate_stems.matched.missed"), d > 0.5 ? 36 : 0);
  }
  EXPECT_EQ(stems(moved(square(), 1, SE3::from_yaw(0, {1, 0, 0}))).at("duplicate_stems.pairs"), 0);
}

TEST(DuplicateStems, TreesOfIslandsThatAreNotTiedStandTwice) {
  const TemporaryFolder folder;
  Atlas islands = square();
  islands.islands = {{{0}, {}}, {{1}, {}}};
  islands.missions[1].island = 1;
  write_truth(islands, folder.path());
  const Metrics m = stems(islands, folder.path());
  EXPECT_EQ(m.at("duplicate_stems.count"), 36);
  EXPECT_EQ(m.at("duplicate_stems.pairs"), 0);
  EXPECT_EQ(m.count("duplicate_stems.matched.rms"), 0u);
}

TEST(DuplicateStems, SightingsAndModelsDecideWhatIsATree) {
  EXPECT_EQ(stems(square(), {}, "{min_sightings: 5}").at("duplicate_stems.pairs"), 0);
  EXPECT_EQ(stems(square(), {}, "{min_sightings: 1}").at("duplicate_stems.pairs"), 36);
  const Metrics all = stems(moved(square(), 1, SE3::from_yaw(0, {0, -6, 0})), {},
                            "{min_sightings: 1, only_reconstructed: false}");
  EXPECT_EQ(all.at("duplicate_stems.pairs"), 18 + 4);  // half of the square, and the shadows
  EXPECT_THROW(component<Evaluator>("duplicate_stems", "{merge_distance: 0.5}"), Error);
}

TEST(DuplicateStems, TakesTablesThatSayNothing) {
  Tree nowhere;
  nowhere.reconstructed = true;
  nowhere.base.x() = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<Tree>& trees : {std::vector<Tree>{}, std::vector<Tree>{nowhere}}) {
    Mission a = make_mission("a", {SE3{}}), b = make_mission("b", {SE3{}});  // b: no payload
    a.nodes[0].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(trees)});
    EXPECT_EQ(stems(tied(make_atlas({a, b}))).at("duplicate_stems.pairs"), 0);
  }
}

}  // namespace
}  // namespace cambium::testing
