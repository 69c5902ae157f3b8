// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "support/support.hpp"

namespace cambium::testing {
namespace {

struct Seen {
  SE3 T_mission_node;  ///< for levelling
  Cloud cloud;
};

Atlas atlas_of(const std::vector<Seen>& reference, const std::vector<Seen>& query) {
  std::vector<Mission> missions;
  for (const auto* seen : {&reference, &query}) {
    std::vector<SE3> poses;
    for (const Seen& s : *seen) poses.push_back(s.T_mission_node);
    missions.push_back(make_mission(missions.empty() ? "a" : "b", poses));
    for (std::size_t i = 0; i < seen->size(); ++i)
      missions.back().nodes[i].payload = in_memory((*seen)[i].cloud);
  }
  return make_atlas(std::move(missions));
}

std::vector<Candidate> match(const std::string& yaml, const std::vector<Seen>& reference,
                             const std::vector<Seen>& query, int threads = 1) {
  const Atlas atlas = atlas_of(reference, query);
  const auto recognizer = component<PlaceRecognizer>("bev_density", yaml);
  const auto context = make_context(threads);
  return recognizer->match(recognizer->describe({atlas, 1}, *context),
                           recognizer->describe({atlas, 0}, *context), {}, *context);
}

/// A node that stands at T_world_base in the forest; its mission knows only roll and pitch.
Seen look(const SE3& T_world_base, std::uint64_t forest = 1) {
  return {{T_world_base.q, Vec3::Zero()}, forest_scan(T_world_base, forest)};
}

SE3 place(std::size_t i, double yaw = 0, const Vec3& beside = Vec3::Zero()) {
  return SE3::from_yaw(yaw, Vec3(60.0 * double(i), 0, 1.5) + beside);
}

std::vector<Seen> places(std::size_t count, std::uint64_t forest = 1) {
  std::vector<Seen> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(look(place(i), forest));
  return out;
}

TEST(BevDensity, ACopiedPlaceIsFoundFirstAndAtOnce) {
  const auto found = match("{candidates: 1}", places(8), places(8));
  ASSERT_EQ(found.size(), 8u);
  for (const Candidate& c : found) {
    EXPECT_EQ(c.query, c.reference);
    ASSERT_TRUE(c.T_reference_query);
    EXPECT_LT(c.T_reference_query->t.norm(), 1e-6);
    EXPECT_LT(rotation_angle(*c.T_reference_query), 1e-6);
  }
}

TEST(BevDensity, TheGuessIsTheTurnAndTheShiftBetweenTwoViews) {
  std::vector<Seen> query;
  std::vector<SE3> truth;
  for (std::size_t i = 0; i < 8; ++i) {
    const SE3 T_world_query = place(i, 0.8 * double(i), {2.0, -1.5, 0.2});
    query.push_back(look(T_world_query));
    truth.push_back(place(i).inverse() * T_world_query);
  }
  const auto found = match("{candidates: 1}", places(8), query);
  std::size_t right = 0;
  for (const Candidate& c : found) {
    const SE3 error = truth[c.query].inverse() * *c.T_reference_query;
    right += c.query == c.reference && error.t.norm() < 0.3 && rotation_angle(error) < 0.02;
  }
  EXPECT_GE(right, 7u) << "of 8; proposed: " << found.size();
}

TEST(BevDensity, ATiltedSensorIsSetUprightAndTheGuessHasItsTilt) {
  const SE3 tilt{Quat(Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 1, 0).normalized())), {1, 0, 0}};
  std::vector<Seen> query;
  for (std::size_t i = 0; i < 4; ++i) query.push_back(look(place(i) * tilt));
  const auto found = match("{candidates: 1}", places(4), query);
  ASSERT_EQ(found.size(), 4u);
  for (const Candidate& c : found) {
    EXPECT_EQ(c.query, c.reference);
    const SE3 error = tilt.inverse() * *c.T_reference_query;
    EXPECT_LT(error.t.norm(), 0.3);
    EXPECT_LT(rotation_angle(error), 0.02);
  }
}

TEST(BevDensity, WhatIsDenseBecauseItIsNearIsNoBrighter) {
  Seen once = look(place(0)), often = once;
  for (std::size_t i = once.cloud.size(); i-- > 0;)  // all of it once more, from the end
    for (std::size_t k = 0; k < 3; ++k) often.cloud.xyz.push_back(once.cloud.xyz[3 * i + k]);
  const Atlas atlas = atlas_of({once}, {often});
  const auto recognizer = component<PlaceRecognizer>("bev_density");
  const auto context = make_context();
  const Fingerprints a = recognizer->describe({atlas, 0}, *context),
                     b = recognizer->describe({atlas, 1}, *context);
  EXPECT_GT(a.row(0).back(), 20.0f);  // corners
  EXPECT_EQ(a.extra, b.extra);
}

TEST(BevDensity, AnotherForestIsNotTakenForThisOne) {
  const auto best = [](const std::vector<Candidate>& found) {
    double out = 0;
    for (const Candidate& c : found) out = std::max(out, c.score);
    return out;
  };
  EXPECT_LT(best(match("{}", places(6, 1), places(6, 2))),
            0.25 * best(match("{}", places(6, 1), places(6, 1))));
}

TEST(BevDensity, ManyThreadsGiveTheSameCandidates) {
  const auto one = match("{}", places(6), places(6), 1),
             four = match("{}", places(6), places(6), 4);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].score, four[i].score);
    EXPECT_EQ(one[i].T_reference_query->matrix(), four[i].T_reference_query->matrix());
  }
}

TEST(BevDensity, NothingToSeeMatchesNothing) {
  Seen empty, flat;
  for (int i = 0; i < 3000; ++i)
    for (const float v : {float(i % 60) - 30, float(i / 60) - 25, -1.5f})
      flat.cloud.xyz.push_back(v);
  EXPECT_TRUE(match("{}", {empty, empty}, {empty, look(place(0))}).empty());
  EXPECT_TRUE(match("{}", {flat}, {look(place(0))}).empty());
}

TEST(BevDensity, RefusesBadParameters) {
  for (const char* yaml : {"{cell: 0}", "{lowest: 5, highest: 5}", "{layers: 65}", "{patch: 3}",
                           "{cell: 0.05, max_range: 200}", "{max_bits: 257}"})
    EXPECT_THROW(component<PlaceRecognizer>("bev_density", yaml), Error) << yaml;
}

}  // namespace
}  // namespace cambium::testing
