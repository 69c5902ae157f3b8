// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

constexpr double pi = std::numbers::pi;

// Seen nodes: a pose, for levelling, and a cloud.
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
  const auto recognizer = component<PlaceRecognizer>("scan_context", yaml);
  const auto context = make_context(threads);
  return recognizer->match(recognizer->describe({atlas, 1}, *context),
                           recognizer->describe({atlas, 0}, *context), {}, *context);
}

// Places of one forest, 60 m apart: no two scans overlap.
std::vector<Seen> places(std::size_t count, std::uint64_t forest = 1) {
  std::vector<Seen> out;
  for (std::size_t i = 0; i < count; ++i)
    out.push_back({{}, forest_scan(SE3::from_yaw(0, {60.0 * double(i), 0, 1.5}), forest, 8000)});
  return out;
}

Seen turned(const Seen& seen, const SE3& T_new_old) {
  return {seen.T_mission_node * T_new_old.inverse(), transformed(T_new_old, seen.cloud)};
}

double angle_between(const SE3& a, const SE3& b) { return rotation_angle(a.inverse() * b); }

TEST(ScanContext, ACopiedPlaceIsFoundFirst) {
  const auto forest = places(12);
  const auto candidates = match("{candidates: 1, threshold: 1}", forest, forest);
  ASSERT_EQ(candidates.size(), 12u);
  for (const auto& c : candidates) {
    EXPECT_EQ(c.query, c.reference);
    EXPECT_NEAR(c.score, 1.0, 1e-5);
    EXPECT_LT(rotation_angle(*c.T_reference_query), 0.02);
  }
}

// Half a sector more than a multiple would be the worst case for binning; a multiple is exact up to
// the points that rounding moves over a border.
TEST(ScanContext, TurningByAnyNumberOfSectorsChangesOnlyTheYaw) {
  const Seen place = places(1).front();
  for (const int sectors : {7, 60, 100}) {
    const std::string yaml = "{sectors: " + std::to_string(sectors) + "}";
    for (int k = 0; k < sectors; k += 3) {
      const SE3 T_reference_query = SE3::from_yaw(2 * pi * k / sectors);
      const auto candidates = match(yaml, {place}, {turned(place, T_reference_query.inverse())});
      ASSERT_EQ(candidates.size(), 1u);
      EXPECT_GT(candidates[0].score, 0.999);
      EXPECT_LT(angle_between(*candidates[0].T_reference_query, T_reference_query), 0.01)
          << k << " of " << sectors;
    }
  }
}

TEST(ScanContext, BetweenSectorsTheYawIsInterpolated) {
  const Seen place = places(1).front();
  for (int degree = 0; degree < 12; ++degree) {  // two sectors of 6 degrees
    const SE3 T_reference_query = SE3::from_yaw(pi * degree / 180.0);
    const auto candidates = match("{}", {place}, {turned(place, T_reference_query.inverse())});
    ASSERT_EQ(candidates.size(), 1u);
    EXPECT_LT(angle_between(*candidates[0].T_reference_query, T_reference_query), pi * 2 / 180.0)
        << degree << " degrees";
  }
}

TEST(ScanContext, ATiltedBaseIsLevelledByItsPose) {
  const Seen place = places(1).front();
  Vec6 tilt;
  tilt << 0, 0, 0, 0.25, -0.2, 0;
  const SE3 T_query_reference = SE3::exp(tilt) * SE3::from_yaw(2 * pi * 11 / 60);
  const Seen query = turned(place, T_query_reference);
  const auto level = match("{}", {place}, {query});
  ASSERT_EQ(level.size(), 1u);
  EXPECT_GT(level[0].score, 0.98);
  EXPECT_LT(angle_between(*level[0].T_reference_query, T_query_reference.inverse()), 0.06);
  const auto tilted = match("{level: false, threshold: 1}", {place}, {query});
  ASSERT_EQ(tilted.size(), 1u);
  EXPECT_LT(tilted[0].score, level[0].score);
}

TEST(ScanContext, ViewpointsGiveTheTranslation) {
  const Seen reference = {{}, forest_scan(SE3::from_yaw(0, {0, 0, 1.5}), 3, 30000)};
  const SE3 T_reference_query = SE3::from_yaw(1.0, {6, -4, 0});
  const Seen query = {
      {}, forest_scan(SE3{Quat::Identity(), {0, 0, 1.5}} * T_reference_query, 3, 30000)};
  const std::string common = "max_range: 20, threshold: 1";
  const auto base = match("{" + common + "}", {reference}, {query});
  const auto views = match("{" + common + ", view_radius: 8, view_step: 1}", {reference}, {query});
  ASSERT_EQ(base.size(), 1u);
  ASSERT_EQ(views.size(), 1u);
  EXPECT_GT(views[0].score, base[0].score);
  EXPECT_LT((views[0].T_reference_query->t - T_reference_query.t).norm(), 1.5);
  EXPECT_LT(angle_between(*views[0].T_reference_query, T_reference_query), 0.1);
}

// The definition, step by step and in double: every shift, every column.
double distance_by_definition(const Cloud& query, const Cloud& reference, int rings, int sectors) {
  const auto describe = [&](const Cloud& cloud) {
    std::vector<std::vector<double>> columns(std::size_t(sectors),
                                             std::vector<double>(std::size_t(rings), 0.0));
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      const Eigen::Vector3f p = cloud.points().col(Eigen::Index(i));
      const double range = std::hypot(double(p.x()), double(p.y()));
      double turns = std::atan2(double(p.y()), double(p.x())) / (2 * pi);
      if (turns < 0) turns += 1;
      if (range >= 80.0) continue;
      double& bin = columns[std::size_t(turns * sectors)][std::size_t(range / 80.0 * rings)];
      bin = std::max(bin, double(p.z()) + 2.0);
    }
    return columns;
  };
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
  };
  const auto q = describe(query), r = describe(reference);
  double best = 1;
  for (std::size_t k = 0; k < q.size(); ++k) {
    double sum = 0;
    int n = 0;
    for (std::size_t s = 0; s < q.size(); ++s) {
      const auto &a = q[s], &b = r[(s + k) % q.size()];
      if (dot(a, a) == 0 || dot(b, b) == 0) continue;
      sum += 1 - dot(a, b) / std::sqrt(dot(a, a) * dot(b, b));
      ++n;
    }
    if (n > 0) best = std::min(best, sum / n);
  }
  return best;
}

// A point in every third sector or so, in the middle of its bin: no rounding across borders.
Cloud in_bins(std::uint64_t seed, int rings, int sectors) {
  Cloud cloud;
  std::uint64_t state = seed;
  const auto next = [&] {
    return (state = state * 6364136223846793005u + 1442695040888963407u) >> 33;
  };
  for (int i = 0; i < 3 * sectors; ++i) {
    const double azimuth = 2 * pi * (double(next() % std::uint64_t(sectors)) + 0.5) / sectors;
    const double range = 80.0 * (double(next() % std::uint64_t(rings)) + 0.5) / rings;
    if (azimuth > 4.0 + double(seed % 3)) continue;  // a part of the circle stays unseen
    cloud.xyz.insert(cloud.xyz.end(),
                     {float(range * std::cos(azimuth)), float(range * std::sin(azimuth)),
                      float(next() % 1000) / 100.0f - 3.0f});
  }
  return cloud;
}

TEST(ScanContext, AgreesWithTheDefinition) {
  for (const auto& [rings, sectors] : {std::pair(20, 60), {10, 60}, {7, 31}, {5, 128}, {3, 200}}) {
    std::vector<Seen> reference, query;
    for (std::uint64_t i = 0; i < 20; ++i) {
      reference.push_back({{}, in_bins(i, rings, sectors)});
      query.push_back({{}, in_bins(100 + i, rings, sectors)});
    }
    const auto candidates =
        match("{rings: " + std::to_string(rings) + ", sectors: " + std::to_string(sectors) +
                  ", threshold: 1, min_overlap: 0, candidates: 100}",
              reference, query);
    ASSERT_EQ(candidates.size(), 400u);
    for (const auto& c : candidates)
      EXPECT_NEAR(1.0 - c.score,
                  distance_by_definition(query[c.query].cloud, reference[c.reference].cloud, rings,
                                         sectors),
                  2e-5);
  }
}

TEST(ScanContext, TheBestOfAllAreKeptBestFirst) {
  const auto reference = places(40, 1), query = places(20, 2);
  const auto all = match("{threshold: 1, candidates: 1000}", reference, query);
  const auto few = match("{threshold: 1, candidates: 3}", reference, query);
  ASSERT_EQ(all.size(), 800u);
  ASSERT_EQ(few.size(), 60u);
  for (std::size_t i = 0; i < few.size(); ++i) {
    EXPECT_EQ(few[i].reference, all[i / 3 * 40 + i % 3].reference);
    EXPECT_EQ(few[i].score, all[i / 3 * 40 + i % 3].score);
  }
}

TEST(ScanContext, OfEqualPlacesTheFirstWins) {
  const Seen place = places(1).front();
  const auto candidates = match("{candidates: 2}", {place, place, place}, {place});
  ASSERT_EQ(candidates.size(), 2u);
  EXPECT_EQ(candidates[0].reference, 0u);
  EXPECT_EQ(candidates[1].reference, 1u);
}

TEST(ScanContext, TheSameForAnyThreadCount) {
  const auto reference = places(40, 1), query = places(40, 2);
  const auto one = match("{threshold: 1, view_radius: 2}", reference, query, 1);
  const auto four = match("{threshold: 1, view_radius: 2}", reference, query, 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].reference, four[i].reference);
    EXPECT_EQ(one[i].score, four[i].score);
  }
}

TEST(ScanContext, OnlyAllowedPairsWithinAMission) {
  auto path = places(5);
  path.push_back(path[0]);
  path.push_back(path[1]);
  const Atlas atlas = atlas_of(path, path);
  Pairing pairing{true, 150.0, {0, 60, 120, 180, 240, 300, 360}, {0, 60, 120, 180, 240, 300, 360}};
  const auto recognizer = component<PlaceRecognizer>("scan_context", "{threshold: 1}");
  const auto context = make_context();
  const auto fingerprints = recognizer->describe({atlas, 0}, *context);
  const auto candidates = recognizer->match(fingerprints, fingerprints, pairing, *context);
  ASSERT_FALSE(candidates.empty());
  for (const auto& c : candidates) EXPECT_TRUE(pairing.allowed(c.query, c.reference));
  const auto best = std::max_element(candidates.begin(), candidates.end(),
                                     [](auto& a, auto& b) { return a.score < b.score; });
  EXPECT_EQ(best->query, best->reference + 5);
}

TEST(ScanContext, CloudsWithoutEnoughInCommonMatchNothing) {
  const Seen whole = places(1).front();
  Cloud three, not_finite = whole.cloud;
  three.xyz = {5, 0, 0, 6, 1, 1, 7, 2, 0.5f};
  std::fill(not_finite.xyz.begin(), not_finite.xyz.end(), std::numeric_limits<float>::quiet_NaN());
  const std::vector<Seen> poor = {{{}, Cloud{}}, {{}, three}, {{}, not_finite}};
  EXPECT_TRUE(match("{threshold: 1}", poor, poor).empty());
  EXPECT_TRUE(match("{threshold: 1}", {whole}, poor).empty());
  // Without the limit, the three points match themselves, and only themselves.
  const auto free = match("{threshold: 1, min_overlap: 0}", poor, poor);
  ASSERT_EQ(free.size(), 1u);
  EXPECT_EQ(free[0].query, 1u);
  EXPECT_EQ(free[0].reference, 1u);
}

TEST(ScanContext, PointsThatAreNotFiniteCountAsNotSeen) {
  const Seen place = places(1).front();
  Seen dirty = place;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  dirty.cloud.xyz.insert(dirty.cloud.xyz.end(), {nan, 1, 1, 1, nan, 1, 1, 1, nan, 1e30f, 0, 0});
  const auto candidates = match("{}", {place}, {dirty});
  ASSERT_EQ(candidates.size(), 1u);
  EXPECT_NEAR(candidates[0].score, 1.0, 1e-5);
}

TEST(ScanContext, NoNodesNoPairs) {
  EXPECT_TRUE(match("{}", {}, places(1)).empty());
  EXPECT_TRUE(match("{}", places(1), {}).empty());
}

TEST(ScanContext, DescriptionsOfOtherGridsAreRefused) {
  const Atlas atlas = atlas_of(places(1), places(1));
  const auto context = make_context();
  const auto coarse = component<PlaceRecognizer>("scan_context", "{rings: 10}");
  const auto fine = component<PlaceRecognizer>("scan_context", "{rings: 20}");
  EXPECT_THROW(fine->match(coarse->describe({atlas, 0}, *context),
                           fine->describe({atlas, 1}, *context), {}, *context),
               Error);
}

TEST(ScanContext, RefusesBadParameters) {
  for (const char* yaml :
       {"{rings: 0}", "{sectors: 3}", "{max_range: 0}", "{candidates: 0}", "{threshold: 1.5}",
        "{min_overlap: -0.1}", "{view_radius: -1}", "{view_step: 0}", "{ring: 3}"})
    EXPECT_THROW(component<PlaceRecognizer>("scan_context", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
