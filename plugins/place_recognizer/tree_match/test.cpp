// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <limits>
#include <numbers>

#include "cambium/statistics.hpp"
#include "support/support.hpp"

namespace cambium::testing {
namespace {

/// Reproducible numbers in 0..1.
struct Numbers {
  std::uint64_t state;
  double operator()() {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return double(state >> 33) / double(1u << 31);
  }
};

/// Trees of a world of 240 x 120 m; `seed` names the forest.
std::vector<Tree> forest(std::uint64_t seed) {
  Numbers next{seed};
  std::vector<Tree> trees;
  for (int i = 0; i < 1600; ++i) {
    Tree t;
    t.base = Vec3(240 * next() - 120, 120 * next() - 60, 0);
    t.base.z() = 2 * std::sin(t.base.x() / 30) - 1.5;
    t.dbh = 0.1 + 0.4 * next();
    t.reconstructed = true;
    trees.push_back(t);
  }
  return trees;
}

/// A mission along `truth` (T_world_node), in the frame of its first node, with noise on the stems.
Mission walk(const std::string& name, const std::vector<Tree>& world,
             const std::vector<SE3>& truth) {
  std::vector<SE3> poses;
  for (const SE3& T : truth) poses.push_back(truth[0].inverse() * T);
  Mission mission = make_mission(name, poses);
  Numbers next{name.size() + 99};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    std::vector<Tree> seen;
    for (Tree t : world) {
      t.base = truth[i].inverse() * t.base;
      if (t.base.head<2>().norm() > 25 || next() < 0.2) continue;
      for (int k = 0; k < 3; ++k) t.base[k] += 0.1 * (next() - 0.5);
      seen.push_back(t);
    }
    mission.nodes[i].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(std::move(seen))});
  }
  return mission;
}

std::vector<SE3> line(double from, double to, double y, double yaw) {
  std::vector<SE3> out;
  const int steps = int(std::abs(to - from) / 2);
  for (int i = 0; i <= steps; ++i) {
    const double x = from + (to - from) * i / steps;
    out.push_back(SE3::from_yaw(yaw, {x, y, 2 * std::sin(x / 30)}));
  }
  return out;
}

std::vector<Candidate> match(const Mission& query, const Mission& reference,
                             const std::string& yaml = "{}", int threads = 1) {
  const auto recognizer = component<PlaceRecognizer>("tree_match", yaml);
  const auto context = make_context(threads);
  const Atlas q = make_atlas({query}), r = make_atlas({reference});
  return recognizer->match(recognizer->describe({q, 0}, *context),
                           recognizer->describe({r, 0}, *context), {}, *context);
}

TEST(TreeMatch, FindsTheReversedPathAndItsPose) {
  const auto world = forest(1);
  const auto there = line(-80, 80, 0, 0), back = line(80, -80, 6, std::numbers::pi);
  const auto found = match(walk("b", world, back), walk("a", world, there));
  EXPECT_GE(found.size(), back.size() * 9 / 10);
  for (const Candidate& c : found) {
    const SE3 error = (there[c.reference].inverse() * back[c.query]).inverse() *
                      c.T_reference_query.value_or(SE3{});
    EXPECT_LT(error.t.norm(), 0.3) << c.query;
    EXPECT_LT(rotation_angle(error), 0.03) << c.query;
  }
}

TEST(TreeMatch, AnotherForestIsRefused) {
  EXPECT_TRUE(
      match(walk("b", forest(2), line(80, -80, 0, 0)), walk("a", forest(1), line(-80, 80, 0, 0)))
          .empty());
}

TEST(TreeMatch, NoPairIsFartherApartThanAllowed) {
  const auto world = forest(1);
  const Mission a = walk("a", world, line(-80, 80, 0, 0)),
                b = walk("b", world, line(80, -80, 20, std::numbers::pi));
  EXPECT_FALSE(match(b, a).empty());
  EXPECT_TRUE(match(b, a, "{max_distance: 15}").empty());
}

/// The bases of nodes `from` to `to` lie this much too high.
Mission lifted(Mission mission, std::size_t from, std::size_t to, double height) {
  for (std::size_t i = from; i < to; ++i) {
    auto trees = *mission.nodes[i].payload->load().trees;
    for (Tree& t : trees) t.base.z() += height;
    mission.nodes[i].payload =
        in_memory(Payload{nullptr, std::make_shared<const std::vector<Tree>>(std::move(trees))});
  }
  return mission;
}

double worst_height_error(const std::vector<Candidate>& found, const std::vector<SE3>& query,
                          const std::vector<SE3>& reference) {
  double worst = 0;
  for (const Candidate& c : found) {
    const SE3 error = (reference[c.reference].inverse() * query[c.query]).inverse() *
                      c.T_reference_query.value_or(SE3{});
    worst = std::max(worst, std::abs(error.t.z()));
  }
  return worst;
}

TEST(TreeMatch, HeightsAreThoseThatTheNeighboursAgreeOn) {
  const auto world = forest(1);
  const auto there = line(-80, 80, 0, 0), back = line(80, -80, 6, std::numbers::pi);
  const Mission a = walk("a", world, there), b = lifted(walk("b", world, back), 30, 45, 1.5);
  EXPECT_LT(worst_height_error(match(b, a), back, there), 0.3);
  EXPECT_GT(worst_height_error(match(b, a, "{consensus_window: 0}"), back, there), 0.8);
}

TEST(TreeMatch, NeighboursVouchForAnAnswerThatIsNotSure) {
  const auto world = forest(1);
  const auto there = line(-80, 80, 0, 0), back = line(80, -80, 32, std::numbers::pi);
  const Mission a = walk("a", world, there), b = walk("b", world, back);
  std::vector<double> scores;
  for (const Candidate& c : match(b, a)) scores.push_back(c.score);
  const std::string half = "min_score: " + std::to_string(median(scores));  // are sure
  const auto alone = match(b, a, "{min_support: 1000, " + half + "}"),
             together = match(b, a, "{" + half + "}");
  EXPECT_LT(alone.size(), 6 * scores.size() / 10);
  EXPECT_GT(together.size(), 9 * scores.size() / 10);
  for (const Candidate& c : together)
    EXPECT_LT(
        (there[c.reference].inverse() * back[c.query] * c.T_reference_query->inverse()).t.norm(),
        0.5);
}

// Two paths that cross: only some of the nodes see what the other mission saw, and probes between
// them must be as good.
TEST(TreeMatch, ProbesLoseNothingWhereMissionsMeetForAShortWhileOnly) {
  const auto world = forest(1);
  std::vector<SE3> across;
  for (double y = -58; y <= 58; y += 2) across.push_back(SE3::from_yaw(1.57, {70, y, 0}));
  const Mission a = walk("a", world, line(-80, 80, 0, 0)), b = walk("b", world, across);
  const auto probed = match(b, a, "{probe_spacing: 40}"), all = match(b, a, "{probe_spacing: 0}");
  EXPECT_GT(all.size(), 10u);
  EXPECT_LT(all.size(), across.size());
  ASSERT_EQ(probed.size(), all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(probed[i].query, all[i].query);
    EXPECT_EQ(probed[i].score, all[i].score);
  }
}

TEST(TreeMatch, WhereNoProbeFindsAnythingNothingElseIsTried) {
  const auto world = forest(1);
  const Mission a = walk("a", world, line(-110, -50, 0, 0)),
                b = walk("b", world, line(110, -80, 0, 0));
  EXPECT_FALSE(match(b, a).empty());
  // The first node, the only probe then, stands at the other end of the forest.
  EXPECT_TRUE(match(b, a, "{probe_spacing: 1000}").empty());
}

TEST(TreeMatch, ALatticeIsRefused) {
  std::vector<Tree> world;
  for (int x = -30; x <= 30; ++x)
    for (int y = -15; y <= 15; ++y) {
      Tree t;
      t.base = Vec3(4 * x, 4 * y, -1.5);
      t.dbh = 0.2;
      t.reconstructed = true;
      world.push_back(t);
    }
  EXPECT_TRUE(match(walk("b", world, line(40, -40, -14, 0)), walk("a", world, line(-40, 40, 2, 0)))
                  .empty());
}

TEST(TreeMatch, OnlyAllowedPairsWithinAMission) {
  auto path = line(-60, 60, 0, 0);
  for (const SE3& T : line(60, -60, 4, std::numbers::pi)) path.push_back(T);
  const Mission mission = walk("a", forest(1), path);
  const Atlas atlas = make_atlas({mission});
  Pairing pairing{true, 50.0, {}, {}};
  for (std::size_t i = 0; i < path.size(); ++i) pairing.query_path.push_back(2.0 * double(i));
  pairing.reference_path = pairing.query_path;
  const auto recognizer = component<PlaceRecognizer>("tree_match");
  const auto context = make_context();
  const auto fingerprints = recognizer->describe({atlas, 0}, *context);
  const auto found = recognizer->match(fingerprints, fingerprints, pairing, *context);
  EXPECT_FALSE(found.empty());
  for (const Candidate& c : found) {
    EXPECT_TRUE(pairing.allowed(c.query, c.reference));
    EXPECT_GT(c.query, path.size() / 2) << "a stem matched its own recent sightings";
  }
}

TEST(TreeMatch, TheSameForAnyThreadCount) {
  const auto world = forest(1);
  const Mission a = walk("a", world, line(-40, 40, 0, 0)),
                b = walk("b", world, line(40, -40, 5, 1));
  const auto one = match(b, a), three = match(b, a, "{}", 3);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, three[i].score);
    EXPECT_EQ(one[i].T_reference_query->t, three[i].T_reference_query->t);
  }
}

TEST(TreeMatch, EmptyFewAndBrokenTablesMatchNothing) {
  const Mission good = walk("a", forest(1), line(-40, 40, 0, 0));
  std::vector<Tree> three(3), broken = forest(1);
  for (Tree& t : broken) t.base.y() = std::numeric_limits<double>::quiet_NaN();
  for (const auto& world : {std::vector<Tree>{}, three, broken}) {
    const Mission poor = walk("b", world, line(-40, 40, 0, 0));
    EXPECT_TRUE(match(poor, good).empty());
    EXPECT_TRUE(match(good, poor).empty());
  }
  EXPECT_TRUE(match(make_mission("b", {}), good).empty());
  EXPECT_TRUE(match(good, make_mission("b", {SE3{}})).empty());
}

TEST(TreeMatch, FingerprintsOfAnotherRecogniserAreRefused) {
  const auto recognizer = component<PlaceRecognizer>("tree_match");
  const Fingerprints strange{1, 2, {1, 2}, {}};
  EXPECT_THROW(recognizer->match(strange, strange, {}, *make_context()), Error);
}

TEST(TreeMatch, RefusesBadParameters) {
  for (const char* yaml :
       {"{bins: 255}", "{min_matches: 2}", "{cell: 0}", "{radius: -1}", "{neighbors: 5}"})
    EXPECT_THROW(component<PlaceRecognizer>("tree_match", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
