// SPDX-License-Identifier: BSD-3-Clause
// The shipped pipelines on real scans. Skipped where the data is not there.
#include <cmath>
#include <fstream>
#include <set>

#include "cambium/dialect.hpp"
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;

namespace {

std::vector<nlohmann::json> read_ledger(const std::filesystem::path& path) {
  std::vector<nlohmann::json> rows;
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) rows.push_back(nlohmann::json::parse(line));
  return rows;
}

}  // namespace

TEST(RealData, FuseScansOnNewerCollege) {
  const auto data = real_data("missions_newer_college");
  if (data.empty()) GTEST_SKIP() << "missions_newer_college is not here";
  const TemporaryFolder folder;
  const auto run = run_cambium({"run", pipeline("fuse_scans.yaml"), (data / "mission_a").string(),
                            (data / "mission_b").string(), "--out", (folder / "map").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto report = read_json(folder / "map/report.json");
  EXPECT_EQ(report["islands"].size(), 1u);
  EXPECT_LE(metric(report, "ate.rmse"), 0.15);
  EXPECT_EQ(metric(report, "loops.wrong"), 0);
  EXPECT_GE(metric(report, "loops.tied.mission_a.mission_b"), 20);
  EXPECT_LT(metric(report, "map_crispness.ratio"), 1.0);
  std::set<std::int64_t> tied;
  for (const auto& row : read_ledger(folder / "map/ledger.jsonl")) {
    EXPECT_FALSE(row["reason"].get<std::string>().empty()) << row;
    if (row["state"] == "accepted" && row["tail"]["mission"] != row["head"]["mission"])
      tied.insert(row["head"]["id"].get<std::int64_t>());
  }
  EXPECT_GE(tied.size(), 20u);
}

TEST(RealData, CloseLoopsOnNclt) {
  const auto data = real_data("missions_nclt");
  if (data.empty()) GTEST_SKIP() << "missions_nclt is not here";
  const TemporaryFolder folder;
  const auto run = run_cambium({"run", pipeline("close_loops.yaml"), (data / "mission_nclt").string(),
                            "--out", (folder / "map").string()});
  ASSERT_EQ(run.code, 0) << run.err;
  const auto before = read_g2o(data / "mission_nclt/slam_pose_graph.g2o");
  const auto after = read_tum(folder / "map/mission_nclt.tum");
  ASSERT_EQ(before.nodes.size(), after.size());
  const double drift = std::abs(before.nodes.back().T_mission_node.t.z());
  const double left = std::abs(after.back().T_map_node.t.z() - after.front().T_map_node.t.z());
  EXPECT_GT(drift, 15);  // what the odometry alone gives
  EXPECT_LT(left, 2.0);
}
