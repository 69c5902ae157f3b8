// SPDX-License-Identifier: BSD-3-Clause
// Missions become one map by the stems in their scans alone.
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

TEST(FuseStems, TwoRobotsInOneStandMakeOneMapFromTheirScans) {
  const TemporaryFolder folder;
  const auto simulated = run_cambium(
      {"simulate", source("tests/specs/stand_pair.yaml").string(), (folder / "missions").string()});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  for (const char* mission : {"mission_a", "mission_b"})
    ASSERT_FALSE(std::filesystem::exists(folder / "missions" / mission / "individual_trees"));
  const auto run =
      run_cambium({"run", pipeline("fuse_stems.yaml"), (folder / "missions/mission_*").string(),
                   "--out", (folder / "map").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto report = read_json(folder / "map/report.json");
  EXPECT_EQ(report["islands"].size(), 1u);
  EXPECT_EQ(metric(report, "loops.wrong"), 0);
  EXPECT_GE(metric(report, "loops.accepted"), 10);
  EXPECT_LT(metric(report, "ate.rmse"), 0.1);
  EXPECT_LT(metric(report, "inter_mission.translation"), 0.1);
  EXPECT_GE(metric(report, "duplicate_stems.matched"), 30);
  EXPECT_LE(metric(report, "duplicate_stems.count"), 2);
}

// The filters submap and stem_extraction one after the other, as separate streams of payloads.
TEST(FuseStems, ASubmapServesTheExtractionToo) {
  const TemporaryFolder folder;
  const auto simulated = run_cambium(
      {"simulate", source("tests/specs/stand_pair.yaml").string(), (folder / "missions").string()});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  write_file(
      folder / "submaps.yaml",
      "version: 1\n"
      "steps:\n"
      "  - {filter: submap, as: submaps, params: {radius: 10}}\n"
      "  - {filter: stem_extraction, payload: submaps, as: stems, params: {keep_cloud: false}}\n"
      "  - {recognize: tree_match, payload: stems, pairs: between_missions}\n"
      "  - {register: tree_align, payload: stems, params: {sigma_base: 0.2}}\n"
      "  - verify: pairwise_consistency\n"
      "  - optimize: sparse_lm\n"
      "  - evaluate: loops\n");
  const auto run =
      run_cambium({"run", (folder / "submaps.yaml").string(),
                   (folder / "missions/mission_*").string(), "--out", (folder / "map").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto report = read_json(folder / "map/report.json");
  EXPECT_EQ(report["islands"].size(), 1u);
  EXPECT_EQ(metric(report, "loops.wrong"), 0);
}
