// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr double pi = std::numbers::pi;

// What a node saw: its pose in the mission, for levelling, and a cloud.
struct Seen {
  SE3 T_mission_node;
  Cloud cloud;
};

Atlas atlas_of(const std::vector<Seen>& reference, const std::vector<Seen>& query) {
  const auto mission = [](const std::string& name, const std::vector<Seen>& seen) {
    std::vector<SE3> poses;
    for (const Seen& s : seen) poses.push_back(s.T_mission_node);
    Mission out = make_mission(name, poses);
    for (std::size_t i = 0; i < seen.size(); ++i) out.nodes[i].payload = in_memory(seen[i].cloud);
    return out;
  };
  return make_atlas({mission("a", reference), mission("b", query)});
}

std::vector<Candidate> match(const std::string& yaml, const std::vector<Seen>& reference,
                             const std::vector<Seen>& query, int threads = 1) {
  const Atlas atlas = atlas_of(reference, query);
  const auto recognizer = component<PlaceRecognizer>("scan_context_pp", yaml);
  const auto context = make_context(threads);
  return recognizer->match(recognizer->describe({atlas, 1}, *context),
                           recognizer->describe({atlas, 0}, *context), {}, *context);
}

Seen seen_from(double x, double y, double yaw, std::uint64_t forest = 1) {
  return {{}, forest_scan(SE3::from_yaw(yaw, {x, y, 1.5}), forest, 20000)};
}

// A path along x, 12 m from node to node.
std::vector<Seen> ride(std::size_t count) {
  std::vector<Seen> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(seen_from(12.0 * double(i), 0, 0));
  return out;
}

double angle_between(const SE3& a, const SE3& b) { return rotation_angle(a.inverse() * b); }

const char* const contexts[] = {"both", "polar", "cartesian"};

TEST(ScanContextPp, ACopiedPlaceIsFoundFirst) {
  const auto path = ride(8);
  for (const std::string context : contexts) {
    const auto candidates = match("{candidates: 1, context: " + context + "}", path, path);
    ASSERT_EQ(candidates.size(), 8u) << context;
    for (const auto& c : candidates) {
      EXPECT_EQ(c.query, c.reference);
      EXPECT_NEAR(c.score, 1.0, 1e-5);
      EXPECT_LT(c.T_reference_query->t.norm(), 0.2);
      EXPECT_LT(rotation_angle(*c.T_reference_query), 0.02);
    }
  }
}

// The law behind the reversed view: turning by half a turn is a flip of both axes.
TEST(ScanContextPp, ACloudThatIsTurnedByHalfATurnScoresAsIfItWereNot) {
  const Seen place = seen_from(0, 0, 0);
  const SE3 half_turn = SE3::from_yaw(pi);
  const Seen turned{half_turn, transformed(half_turn, place.cloud)};
  const auto candidates = match("{context: cartesian}", {place}, {turned});
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_GT(candidates[0].score, 0.999);
  EXPECT_LT(angle_between(*candidates[0].T_reference_query, half_turn), 1e-6);
}

TEST(ScanContextPp, ReversedAndParallelPassesAreFoundAndPlaced) {
  const auto path = ride(8);
  const std::string yaml =
      "{candidates: 1, context: cartesian, length: 24, width: 24, bin: 1.5, "
      "cartesian_threshold: 1, height_offset: 3}";
  for (const double yaw : {0.0, pi})
    for (const double y : {-8.0, 5.0, 10.0}) {
      std::vector<Seen> beside;
      for (std::size_t i = 0; i < path.size(); ++i)
        beside.push_back(seen_from(12.0 * double(i) + 1.0, y, yaw));
      const auto candidates = match(yaml, path, beside);
      ASSERT_EQ(candidates.size(), path.size());
      for (const auto& c : candidates) {
        const std::string what = "yaw " + std::to_string(yaw) + ", " + std::to_string(y) + " m";
        EXPECT_EQ(c.query, c.reference) << what;
        EXPECT_NEAR(c.T_reference_query->t.y(), y, 1.5) << what;
        EXPECT_NEAR(c.T_reference_query->t.x(), 1.0, 2.5) << what;
        EXPECT_LT(angle_between(*c.T_reference_query, SE3::from_yaw(yaw)), 0.15) << what;
      }
    }
}

TEST(ScanContextPp, ThePolarContextKnowsAnyHeadingAndTheSideOfThePass) {
  const auto path = ride(6);
  std::vector<Seen> beside;
  for (std::size_t i = 0; i < path.size(); ++i)
    beside.push_back(seen_from(12.0 * double(i), 4.0, double(i)));
  const auto find = [&](const std::string& views) {
    return match(
        "{candidates: 1, context: polar, max_range: 24, polar_threshold: 1, " + views + "}", path,
        beside);
  };
  double with = 0, without = 0;
  for (const auto& c : find("lateral_views: 0")) without += c.score;
  for (const auto& c : find("lateral_views: 4, lateral_step: 1")) with += c.score;
  EXPECT_GT(with, without);
}

TEST(ScanContextPp, LanesThatAreShiftedOutDoNotComeBack) {
  const auto stripe = [](float y) {
    Cloud cloud;
    for (int i = 0; i < 20; ++i)
      cloud.xyz.insert(cloud.xyz.end(), {float(2 * i) - 19, y, 1.0f + float(i % 3)});
    return Seen{{}, cloud};
  };
  const auto candidates = match(
      "{context: cartesian, min_overlap: 0, width: 20, length: 20, forward_views: 0, "
      "heading_views: 0}",
      {stripe(-19)}, {stripe(19)});
  ASSERT_EQ(candidates.size(), 1u);  // reversed it lies where the other is, or 38 m to the side
  EXPECT_NEAR(std::abs(candidates[0].T_reference_query->t.y()), 0.0, 38.1);
  const auto strict = match("{context: cartesian, min_overlap: 0.5, width: 20, length: 20}",
                            {stripe(-19)}, {stripe(19)});
  EXPECT_TRUE(strict.empty());
}

TEST(ScanContextPp, ATiltedBaseIsLevelledByItsPose) {
  const Seen place = seen_from(0, 0, 0);
  Vec6 tilt;
  tilt << 0, 0, 0, 0.2, -0.15, 0;
  const SE3 T_query_reference = SE3::exp(tilt);
  const Seen query{T_query_reference.inverse(), transformed(T_query_reference, place.cloud)};
  for (const std::string context : contexts) {
    const auto level = match("{context: " + context + "}", {place}, {query});
    ASSERT_EQ(level.size(), 1u) << context;
    EXPECT_GT(level[0].score, 0.8) << context;
    EXPECT_LT(angle_between(*level[0].T_reference_query, T_query_reference.inverse()), 0.06);
  }
}

TEST(ScanContextPp, TheSameForAnyThreadCountAndEachReferenceOnce) {
  const auto path = ride(24);
  const auto one = match("{polar_threshold: 1, cartesian_threshold: 1}", path, path, 1);
  const auto four = match("{polar_threshold: 1, cartesian_threshold: 1}", path, path, 4);
  ASSERT_EQ(one.size(), four.size());
  ASSERT_GE(one.size(), 24u * 5u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].reference, four[i].reference);
    EXPECT_EQ(one[i].score, four[i].score);
    EXPECT_TRUE(one[i].T_reference_query->t == four[i].T_reference_query->t);
    for (std::size_t j = i + 1; j < one.size() && one[j].query == one[i].query; ++j) {
      EXPECT_NE(one[j].reference, one[i].reference);
    }
  }
}

TEST(ScanContextPp, OnlyAllowedPairsWithinAMission) {
  auto path = ride(5);
  path.push_back(path[0]);
  path.push_back(path[1]);
  const Atlas atlas = atlas_of(path, path);
  const std::vector<double> travelled = {0, 60, 120, 180, 240, 300, 360};
  const Pairing pairing{true, 150.0, travelled, travelled};
  const auto recognizer = component<PlaceRecognizer>("scan_context_pp", "{}");
  const auto context = make_context();
  const auto fingerprints = recognizer->describe({atlas, 0}, *context);
  const auto candidates = recognizer->match(fingerprints, fingerprints, pairing, *context);
  ASSERT_FALSE(candidates.empty());
  for (const auto& c : candidates) EXPECT_TRUE(pairing.allowed(c.query, c.reference));
}

TEST(ScanContextPp, CloudsWithoutEnoughInCommonMatchNothing) {
  const Seen whole = seen_from(0, 0, 0);
  Cloud not_finite = whole.cloud, three;
  three.xyz = {5, 0, 0, 6, 1, 1, 7, 2, 0.5f};
  std::fill(not_finite.xyz.begin(), not_finite.xyz.end(), std::numeric_limits<float>::quiet_NaN());
  const std::vector<Seen> poor = {{{}, Cloud{}}, {{}, three}, {{}, not_finite}};
  EXPECT_TRUE(match("{}", poor, poor).empty());
  EXPECT_TRUE(match("{}", {whole}, poor).empty());
  EXPECT_TRUE(match("{}", {}, {whole}).empty());
  EXPECT_TRUE(match("{}", {whole}, {}).empty());
}

TEST(ScanContextPp, DescriptionsOfOtherGridsAreRefused) {
  const Atlas atlas = atlas_of(ride(1), ride(1));
  const auto context = make_context();
  const auto mine = component<PlaceRecognizer>("scan_context_pp", "{}");
  const auto of_mine = mine->describe({atlas, 0}, *context);
  for (const char* yaml : {"{rings: 10}", "{bin: 1}", "{context: polar}", "{lateral_views: 0}"}) {
    const auto other = component<PlaceRecognizer>("scan_context_pp", yaml);
    EXPECT_THROW(mine->match(other->describe({atlas, 1}, *context), of_mine, {}, *context), Error)
        << yaml;
  }
}

TEST(ScanContextPp, RefusesBadParameters) {
  for (const char* yaml :
       {"{context: round}", "{rings: 0}", "{sectors: 3}", "{max_range: 0}", "{candidates: 0}",
        "{polar_threshold: 0}", "{cartesian_threshold: 1.5}", "{bin: 0}", "{bin: 0.1}",
        "{width: 0}", "{lateral_views: -1}", "{lateral_step: 0}", "{forward_views: -1}",
        "{heading_views: -1}", "{heading_step: 0}"})
    EXPECT_THROW(component<PlaceRecognizer>("scan_context_pp", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
