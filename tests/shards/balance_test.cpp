// SPDX-License-Identifier: BSD-3-Clause
// Dealing the pairs of missions to shards, and plans as files.
#include <gtest/gtest.h>

#include <map>

#include "cambium/files.hpp"
#include "engine/program.hpp"
#include "shards/plan.hpp"
#include "support/support.hpp"

namespace cambium::shards {
namespace {

// All pairs of missions with the given numbers of nodes.
Plan plan_of(const std::vector<double>& nodes) {
  Plan plan{"version: 1\nsteps: []\n", program_build().hex(), 2, {}};
  for (std::size_t q = 0; q < nodes.size(); ++q)
    for (std::size_t r = 0; r <= q; ++r)
      plan.pairs.push_back({"m" + std::to_string(q), "m" + std::to_string(r), nodes[q]});
  return plan;
}

double cost(const Plan& plan, const std::vector<SharePart>& parts) {
  double sum = 0;
  for (const SharePart& part : parts)
    for (const Pair& p : plan.pairs)
      if (p.query == part.query && p.reference == part.reference)
        sum += p.cost / double(part.slices);
  return sum;
}

TEST(Shards, AreDisjointAndTogetherEverything) {
  for (const auto& nodes : {std::vector<double>{100}, {500, 20, 20}, {1, 2, 3, 4, 5, 6, 7}})
    for (const std::size_t count : {1u, 2u, 5u, 13u}) {
      const Plan plan = plan_of(nodes);
      std::map<std::pair<std::string, std::string>, std::map<std::size_t, int>> dealt;
      std::map<std::pair<std::string, std::string>, std::size_t> slices;
      for (std::size_t i = 1; i <= count; ++i)
        for (const SharePart& p : shard(plan, i, count)) {
          ++dealt[{p.query, p.reference}][p.slice];
          slices[{p.query, p.reference}] = p.slices;
        }
      EXPECT_EQ(dealt.size(), plan.pairs.size());
      for (const auto& [pair, times] : dealt) {
        EXPECT_EQ(times.size(), slices[pair]);
        for (const auto& [slice, n] : times) EXPECT_EQ(n, 1) << pair.first << " slice " << slice;
      }
    }
}

TEST(Shards, AreAboutEquallyCostly) {
  for (const auto& nodes : {std::vector<double>{100}, {5000, 20, 20}, {10, 20, 30, 400, 50, 60}})
    for (const std::size_t count : {2u, 3u, 8u}) {
      const Plan plan = plan_of(nodes);
      double total = 0;
      for (const Pair& p : plan.pairs) total += p.cost;
      for (std::size_t i = 1; i <= count; ++i) {
        const double mine = cost(plan, shard(plan, i, count));
        EXPECT_LE(mine, 1.25 * total / double(count)) << i << " of " << count;
        EXPECT_GE(mine, 0.7 * total / double(count)) << i << " of " << count;
      }
    }
}

TEST(Shards, RefuseNumbersThatAreNone) {
  EXPECT_THROW(shard(plan_of({1}), 0, 2), Error);
  EXPECT_THROW(shard(plan_of({1}), 3, 2), Error);
}

TEST(Plan, ReadsBackAndRefusesWhatDoesNotFit) {
  const cambium::testing::TemporaryFolder folder;
  const Plan plan = plan_of({3, 4});
  write_file(folder / "plan.json", to_json(plan).dump());
  const Plan again = read_plan(folder / "plan.json");
  EXPECT_EQ(to_json(again), to_json(plan));
  Plan other = plan;
  other.program = "another";
  write_file(folder / "other.json", to_json(other).dump());
  for (const char* text : {"{}", "no json", "[1]", "{\"cambium_plan\": 2}"}) {
    write_file(folder / "bad.json", text);
    EXPECT_THROW(read_plan(folder / "bad.json"), Error) << text;
  }
  try {
    read_plan(folder / "other.json");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::config);
    EXPECT_NE(std::string(e.what()).find("another build"), std::string::npos);
  }
}

}  // namespace
}  // namespace cambium::shards
