// SPDX-License-Identifier: BSD-3-Clause
// `cambium evaluate`: a finished run, measured again.
#include <cmath>
#include <map>
#include <sstream>

#include "cambium/files.hpp"
#include "command.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

/// Two missions over bare ground, tied by nothing, and a run over them that found a metric.
class Evaluate : public ::testing::Test {
 protected:
  Evaluate() {
    write_file(folder_ / "spec.yaml",
               "version: 1\nseed: 5\nstand: {size: [60, 50], density: 0}\n"
               "sensor: {clouds: false}\nodometry: {drift: 2}\ntrees: {enabled: true}\n"
               "missions: [{name: mission_a}, {name: mission_b, path: {reversed: true}}]\n");
    write_file(folder_ / "pipeline.yaml",
               "version: 1\nsteps:\n  - filter: range_crop\n    params: {max_range: 20.0}\n"
               "  - optimize: ceres\n  - evaluate: ate\n  - evaluate: rpe\n");
    expect_done({"simulate", path("spec.yaml"), path("missions")});
    expect_done({"run", path("pipeline.yaml"), path("missions/mission_a"),
                 path("missions/mission_b"), "--out", path("map")});
  }

  static void expect_done(const std::vector<std::string>& arguments) {
    const auto outcome = run_cambium(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
  }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// What `cambium evaluate ARGUMENTS...` prints, by name of the metric.
  std::map<std::string, double> table(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "evaluate");
    const auto outcome = run_cambium(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::map<std::string, double> out;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string name;
      double value = 0;
      if (words >> name >> value) out[name] = value;
    }
    return out;
  }

  TemporaryFolder folder_;
};

}  // namespace

TEST_F(Evaluate, GivesTheFiguresOfTheRun) {
  const auto again = table({path("map"), "-e", "ate", "-e", "rpe"});
  const auto report = read_json(folder_ / "map/report.json");
  ASSERT_EQ(again.size(), report["metrics"].size());
  for (const auto& [name, value] : again)
    EXPECT_NEAR(value, metric(report, name), 1e-3 * std::abs(value)) << name;  // four digits
}

TEST_F(Evaluate, AllEvaluatorsRunWhenNoneIsNamed) {
  const auto all = table({path("map")});
  for (const char* name : {"ate.rmse", "rpe.translation", "loops.accepted", "inter_mission.pairs",
                           "duplicate_stems.count", "ground_separation.cells",
                           "gnss_residuals.fixes", "map_crispness.pairs"})
    EXPECT_TRUE(all.contains(name)) << name;
}

// A truth that lies 3 m beside the missions' own.
TEST_F(Evaluate, TakesAnotherTruthAndParameters) {
  fs::create_directories(folder_ / "truth");
  for (const std::string name : {"mission_a", "mission_b"}) {
    auto rows = read_tum(folder_ / "map" / (name + ".tum"));
    for (auto& row : rows) row.T_map_node.t.y() += 3;
    write_file(folder_ / "truth" / (name + ".tum"), format_tum(rows));
  }
  EXPECT_NEAR(table({path("map"), path("truth"), "-e", "ate"}).at("ate.rmse"), 0, 1e-6);
  EXPECT_NEAR(table({path("map"), path("truth"), "-e", "ate", "--set", "ate.alignment=none"})
                  .at("ate.rmse"),
              3, 1e-3);
}

TEST_F(Evaluate, MistakesSayWhatWasExpected) {
  const auto refusal = [&](std::vector<std::string> arguments, int code) {
    arguments.insert(arguments.begin(), "evaluate");
    const auto outcome = run_cambium(arguments);
    EXPECT_EQ(outcome.code, code) << outcome.err;
    return outcome.err;
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  contains(refusal({path("missions")}, 2), "holds no finished run");
  contains(refusal({path("map"), path("nowhere")}, 2), "is no folder");
  contains(refusal({path("map"), "-e", "atte"}, 2), "did you mean 'ate'?");
  contains(refusal({path("map"), "-e", "ate", "--set", "rpe.deltas=3"}, 2), "one of: ate");
  write_file(folder_ / "map/ledger.jsonl", "{\"tail\": 3}\n");
  contains(refusal({path("map"), "-e", "ate"}, 4), "ledger.jsonl:1");
  fs::remove(folder_ / "map/fused.g2o");
  contains(refusal({path("map"), "-e", "ate"}, 4), "fused.g2o");
}
