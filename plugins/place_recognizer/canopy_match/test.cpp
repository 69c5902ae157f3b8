// SPDX-License-Identifier: BSD-3-Clause
#include <numbers>
#include <random>

#include "cambium/path.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

struct Forest {
  std::vector<Vec3> stems;
};

/// About 500 stems a hectare, no two nearer than 1.5 m, on a slope.
Forest forest(unsigned seed, double half = 40) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-half, half);
  Forest out;
  while (out.stems.size() < std::size_t(0.05 * 4 * half * half)) {
    const Vec3 p(any(random), any(random), 0);
    bool free = true;
    for (const Vec3& s : out.stems) free = free && (s - p).head<2>().norm() > 1.5;
    if (free) out.stems.emplace_back(p.x(), p.y(), 0.1 * p.x());
  }
  return out;
}

/// Nodes at `poses` (T_world_node) in the mission's own frame, each with the trees within 35 m that
/// this mission sees: a share of them, each off by `sigma`, the same way for all nodes.
Mission seen(const std::string& name, const Forest& world, const std::vector<SE3>& T_world_node,
             const SE3& T_world_mission, double share, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> off(0, sigma);
  std::vector<Vec3> trees;
  for (const Vec3& s : world.stems)
    if (std::uniform_real_distribution<double>(0, 1)(random) < share)
      trees.push_back(s + Vec3(off(random), off(random), 0.1 * off(random)));
  std::vector<SE3> poses;
  for (const SE3& T : T_world_node) poses.push_back(T_world_mission.inverse() * T);
  Mission mission = make_mission(name, poses);
  for (std::size_t i = 0; i < T_world_node.size(); ++i) {
    Payload payload;
    std::vector<Tree> table;
    for (const Vec3& p : trees) {
      Tree tree;
      tree.base = T_world_node[i].inverse() * p;
      tree.dbh = std::nan("");
      if (tree.base.head<2>().norm() < 35) table.push_back(tree);
    }
    payload.trees = std::make_shared<const std::vector<Tree>>(std::move(table));
    mission.nodes[i].payload = in_memory(std::move(payload));
  }
  return mission;
}

std::vector<SE3> walk() {
  std::vector<SE3> out;
  for (int i = 0; i < 8; ++i)
    out.push_back(SE3::from_yaw(0.2 * i, {-16.0 + 4 * i, 3.0 * (i % 2), 1.5}));
  return out;
}
std::vector<SE3> flight() {
  std::vector<SE3> out;
  for (int i = 0; i < 4; ++i) out.push_back(SE3::from_yaw(1.0, {-15.0 + 10 * i, 4, 60}));
  return out;
}

std::vector<Candidate> matched(const Mission& query, const Mission& reference,
                               const std::string& yaml = "{min_sightings: 1}", int threads = 1) {
  const auto recognizer = component<PlaceRecognizer>("canopy_match", yaml);
  const Atlas atlas = make_atlas({query, reference});
  const auto context = make_context(threads);
  const std::uint32_t q = query.name < reference.name ? 0 : 1;
  const auto a = recognizer->describe({atlas, q}, *context);
  const auto b = recognizer->describe({atlas, 1 - q}, *context);
  return recognizer->match(a, b, {false, 0, travelled(query), travelled(reference)}, *context);
}

TEST(CanopyMatch, TiesAGroundMissionToTheCanopyAbove) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Forest world = forest(seed);
    // The ground mission's frame is off by 10 m and 15 degrees, or by anything.
    const SE3 off = seed == 3 ? SE3::from_yaw(2.9, {250, -80, 12})
                              : SE3::from_yaw(15 * std::numbers::pi / 180, {8, -6, 1});
    const Mission ground = seen("ground", world, walk(), off, 0.9, 0.05, seed + 10);
    const Mission above = seen("above", world, flight(), SE3{}, 0.65, 0.4, seed + 20);
    const auto found = matched(ground, above);
    ASSERT_EQ(found.size(), walk().size()) << seed;
    for (const Candidate& c : found) {
      const SE3 truth = flight()[c.reference].inverse() * walk()[c.query];
      EXPECT_LT((c.T_reference_query->t - truth.t).norm(), 0.3) << seed;
      EXPECT_LT(rotation_angle(truth.inverse() * *c.T_reference_query), 0.02) << seed;
    }
  }
}

TEST(CanopyMatch, OtherForestsAreNotTied) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Mission ground = seen("ground", forest(seed), walk(), SE3{}, 0.9, 0.05, seed);
    const Mission above = seen("above", forest(seed + 100), flight(), SE3{}, 0.65, 0.4, seed);
    EXPECT_TRUE(matched(ground, above).empty()) << seed;
  }
}

TEST(CanopyMatch, APlantationIsNotTied) {
  Forest rows;
  for (int x = -15; x <= 15; ++x)
    for (int y = -15; y <= 15; ++y) rows.stems.emplace_back(2.5 * x, 2.5 * y, 0);
  const Mission ground = seen("ground", rows, walk(), SE3{}, 1, 0.05, 1);
  const Mission above = seen("above", rows, flight(), SE3{}, 1, 0.1, 2);
  EXPECT_TRUE(matched(ground, above).empty());
}

TEST(CanopyMatch, ThreadsDoNotShow) {
  const Forest world = forest(4);
  const Mission ground = seen("ground", world, walk(), SE3{}, 0.9, 0.05, 1);
  const Mission above = seen("above", world, flight(), SE3{}, 0.65, 0.4, 2);
  const auto one = matched(ground, above), four = matched(ground, above, "{min_sightings: 1}", 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, four[i].score);
    EXPECT_EQ(one[i].T_reference_query->t, four[i].T_reference_query->t);
  }
}

TEST(CanopyMatch, SaysNothingAboutTheLoopsOfOneMission) {
  const auto recognizer = component<PlaceRecognizer>("canopy_match", "{}");
  const Mission ground = seen("ground", forest(1), walk(), SE3{}, 0.9, 0.05, 1);
  const Atlas atlas = make_atlas({ground});
  const auto prints = recognizer->describe({atlas, 0}, *make_context());
  EXPECT_TRUE(
      recognizer
          ->match(prints, prints, {true, 0, travelled(ground), travelled(ground)}, *make_context())
          .empty());
}

}  // namespace
}  // namespace cambium::testing
