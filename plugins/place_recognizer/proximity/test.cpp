// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

// Poses spread over a square of 100 m, the same every time (a low-discrepancy sequence).
std::vector<SE3> scattered(std::size_t count, double seed) {
  std::vector<SE3> out;
  for (std::size_t i = 0; i < count; ++i) {
    const auto part = [&](double step) { return std::fmod(seed + double(i) * step, 1.0); };
    Vec6 xi;
    xi << 100 * part(0.7549), 100 * part(0.5698), 10 * part(0.317), 0.1, -0.1, 6 * part(0.618);
    out.push_back(SE3::exp(xi));
  }
  return out;
}

struct Pair {
  Atlas atlas;
  Pairing pairing;

  Pair(const std::vector<SE3>& reference, const std::vector<SE3>& query)
      : atlas(make_atlas({make_mission("a", reference), make_mission("b", query)})) {
    atlas.missions[1].island = 0;
  }
  std::vector<Candidate> match(const std::string& yaml, int threads = 1) const {
    const auto proximity = component<PlaceRecognizer>("proximity", yaml);
    const auto context = make_context(threads);
    return proximity->match(proximity->describe({atlas, 1}, *context),
                            proximity->describe({atlas, 0}, *context), pairing, *context);
  }
};

TEST(Proximity, FindsExactlyThePairsOfBruteForce) {
  const Pair pair(scattered(150, 0.0), scattered(130, 0.3));
  std::vector<std::pair<std::size_t, std::size_t>> expected, found;
  for (std::size_t q = 0; q < 130; ++q)
    for (std::size_t r = 0; r < 150; ++r) {
      const Vec3 d = pair.atlas.T_map_node({1, std::uint32_t(q)}).t -
                     pair.atlas.T_map_node({0, std::uint32_t(r)}).t;
      if (d.head<2>().norm() <= 12 && std::abs(d.z()) <= 3) expected.emplace_back(q, r);
    }
  for (const auto& c : pair.match("{radius: 12, max_height_difference: 3, candidates: 1000}"))
    found.emplace_back(c.query, c.reference);
  std::sort(found.begin(), found.end());
  ASSERT_GT(expected.size(), 100u);
  EXPECT_EQ(found, expected);
}

TEST(Proximity, TheGuessIsWhatTheMapSays) {
  const Pair pair(scattered(50, 0.0), scattered(50, 0.3));
  const auto candidates = pair.match("{radius: 20}");
  ASSERT_FALSE(candidates.empty());
  for (const auto& c : candidates) {
    const SE3 T = pair.atlas.T_map_node({0, std::uint32_t(c.reference)}) * *c.T_reference_query;
    EXPECT_LT((pair.atlas.T_map_node({1, std::uint32_t(c.query)}).inverse() * T).log().norm(),
              1e-12);
  }
}

TEST(Proximity, TheFlatGuessForgetsHeightAndTilt) {
  Vec6 tilt;
  tilt << 0, 0, 0, 0.2, 0, 0;
  const SE3 reference = SE3::from_yaw(0.5, {10, 20, 0});
  const SE3 T_reference_query = SE3::from_yaw(1.0, {3, 4, 0});
  const SE3 drifted = SE3{Quat::Identity(), {0, 0, 18}} * reference * T_reference_query;
  const Pair pair({reference}, {drifted * SE3::exp(tilt)});
  const auto candidates = pair.match("{max_height_difference: 20, flat_guess: true}");
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_LT((T_reference_query.inverse() * *candidates[0].T_reference_query).log().norm(), 1e-9);
}

TEST(Proximity, TheNearestComeFirstAndTiesByIndex) {
  const Pair pair({SE3{}, SE3::from_yaw(0, {2, 0, 0}), SE3::from_yaw(0, {-2, 0, 0}),
                   SE3::from_yaw(0, {1, 0, 0})},
                  {SE3{}});
  const auto candidates = pair.match("{candidates: 3}");
  ASSERT_EQ(candidates.size(), 3u);
  EXPECT_EQ(candidates[0].reference, 0u);
  EXPECT_EQ(candidates[1].reference, 3u);
  EXPECT_EQ(candidates[2].reference, 1u);
  EXPECT_GT(candidates[0].score, candidates[1].score);
}

TEST(Proximity, OtherIslandsAreOtherMaps) {
  Pair pair({SE3{}}, {SE3{}});
  EXPECT_EQ(pair.match("{}").size(), 1u);
  pair.atlas.missions[1].island = 1;
  EXPECT_TRUE(pair.match("{}").empty());
}

// A straight path of 100 m that comes back 15 m beside itself: drift.
TEST(Proximity, TheRadiusGrowsWithThePathWithinAMission) {
  std::vector<SE3> poses;
  for (int i = 0; i <= 10; ++i) poses.push_back(SE3::from_yaw(0, {10.0 * i, 0, 0}));
  for (int i = 10; i >= 0; --i) poses.push_back(SE3::from_yaw(0, {10.0 * i, 15, 0}));
  const Atlas atlas = make_atlas({make_mission("a", poses)});
  Pairing pairing{true, 50.0, {}, {}};
  for (std::size_t i = 0; i < poses.size(); ++i)
    pairing.query_path.push_back(i <= 10 ? 10.0 * double(i) : 10.0 * double(i) + 5);
  pairing.reference_path = pairing.query_path;
  const auto context = make_context();
  const auto match = [&](const std::string& yaml) {
    const auto proximity = component<PlaceRecognizer>("proximity", yaml);
    const auto fingerprints = proximity->describe({atlas, 0}, *context);
    return proximity->match(fingerprints, fingerprints, pairing, *context);
  };
  EXPECT_TRUE(match("{radius: 10}").empty());
  const auto grown = match("{radius: 10, radius_growth: 0.04, candidates: 1}");
  ASSERT_FALSE(grown.empty());
  for (const auto& c : grown) {
    EXPECT_TRUE(pairing.allowed(c.query, c.reference));
    EXPECT_EQ(c.query + c.reference, 21u);  // the node across
    EXPECT_GE(10.0 + 0.04 * (pairing.query_path[c.query] - pairing.query_path[c.reference]), 15.0);
  }
}

TEST(Proximity, TheSameForAnyThreadCount) {
  const Pair pair(scattered(150, 0.0), scattered(130, 0.3));
  const auto one = pair.match("{radius: 15}", 1), four = pair.match("{radius: 15}", 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].query, four[i].query);
    EXPECT_EQ(one[i].reference, four[i].reference);
  }
}

TEST(Proximity, NoNodesNoPairs) {
  const Pair pair({}, {SE3{}});
  EXPECT_TRUE(pair.match("{}").empty());
}

TEST(Proximity, TellsThatItUsesPoses) {
  EXPECT_TRUE(component<PlaceRecognizer>("proximity")->uses_poses());
}

TEST(Proximity, RefusesBadParameters) {
  for (const char* yaml : {"{radius: 0}", "{radius_growth: -1}", "{max_height_difference: 0}",
                           "{candidates: 0}", "{distance: 3}"})
    EXPECT_THROW(component<PlaceRecognizer>("proximity", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
