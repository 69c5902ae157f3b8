// SPDX-License-Identifier: BSD-3-Clause
// Real pipelines on the adversaries of tests/specs: the map is right, or the run says that there is
// none.
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

const std::string small_scans = source("tests/integration/adversaries.yaml").string();

struct Fused {
  Outcome run;
  nlohmann::json report;

  std::size_t islands() const { return report["islands"].size(); }
  double value(const std::string& name) const { return metric(report, name); }
  bool warned(const std::string& text) const {
    for (const auto& w : report["warnings"])
      if (w.get<std::string>().find(text) != std::string::npos) return true;
    return false;
  }
};

Fused fuse(const std::string& spec, const std::string& pipeline = small_scans) {
  const TemporaryFolder folder;
  const auto simulated = run_cambium(
      {"simulate", source("tests/specs/" + spec + ".yaml").string(), (folder / "missions").string()});
  EXPECT_EQ(simulated.code, 0) << simulated.err;
  Fused out;
  out.run = run_cambium({"run", pipeline, (folder / "missions/mission_*").string(), "--out",
                         (folder / "map").string()});
  EXPECT_EQ(out.run.code, 0) << out.run.err;
  out.report = read_json(folder / "map/report.json");
  return out;
}

void expect_two_islands(const Fused& fused) {
  EXPECT_EQ(fused.islands(), 2u);
  EXPECT_EQ(fused.value("loops.accepted"), 0);
  EXPECT_TRUE(fused.warned("2 islands: no accepted loop ties them together"));
}

void expect_one_good_map(const Fused& fused) {
  EXPECT_EQ(fused.islands(), 1u);
  EXPECT_EQ(fused.value("loops.wrong"), 0);
  EXPECT_LT(fused.value("ate.rmse"), 0.2);
  EXPECT_LT(fused.value("inter_mission.translation"), 0.15);
}

}  // namespace

TEST(Adversary, MissionsThatNeverMeetAreIslands) { expect_two_islands(fuse("never_meet")); }

TEST(Adversary, ExtractedStemsTieNothingInAPlantationOrAClearing) {
  const Fused lattice = fuse("plantation_lattice", pipeline("fuse_stems.yaml"));
  expect_two_islands(lattice);
  // It is not for want of trees: both missions found some that are the same.
  EXPECT_GE(lattice.value("duplicate_stems.matched"), 10);
  expect_two_islands(fuse("empty_clearing", pipeline("fuse_stems.yaml")));
}

TEST(Adversary, APlantationLatticeTiesNothing) {
  expect_two_islands(fuse("plantation_lattice"));
  expect_two_islands(fuse("plantation_lattice", pipeline("fuse_scans.yaml")));
}

TEST(Adversary, TreeTablesOfALatticeOrAClearingTieNothing) {
  for (const char* spec : {"plantation_lattice", "empty_clearing"})
    expect_two_islands(fuse(spec, pipeline("fuse_trees.yaml")));
}

TEST(Adversary, AnEmptyClearingTiesNothing) {
  expect_two_islands(fuse("empty_clearing"));
  expect_two_islands(fuse("empty_clearing", pipeline("fuse_scans.yaml")));
}

TEST(Adversary, AHarvestBetweenTheMissionsDoesNotKeepThemApart) {
  expect_one_good_map(fuse("harvested"));
}

TEST(Adversary, NodesThatShareAStampAreLeftOutOfTheTies) {
  const Fused fused = fuse("duplicate_stamps");
  expect_one_good_map(fused);
  EXPECT_TRUE(fused.warned("6 nodes share their stamp"));
}

// Neither can be put right from scans alone; they must not spoil the other mission, nor be fused
// wrongly.
TEST(Adversary, AMissionWithWrongGravityOrThatWasCarriedDoesNotBendTheOther) {
  for (const char* spec : {"wrong_gravity", "carried"}) {
    const Fused fused = fuse(spec);
    EXPECT_EQ(fused.value("loops.wrong"), 0) << spec;
    EXPECT_LT(fused.value("ate.mission_a.own.rmse"), 0.2) << spec;
    if (fused.islands() == 2) expect_two_islands(fused);
  }
}
