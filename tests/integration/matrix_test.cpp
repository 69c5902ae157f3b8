// SPDX-License-Identifier: BSD-3-Clause
// Matrices and batches as a user runs them.
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

constexpr const char* graph =
    "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 10 0\nVERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 11 0\n"
    "VERTEX_SE3:QUAT_TIME 2 2 0 0 0 0 0 1 12 0\nVERTEX_SE3:QUAT_TIME 3 3 0 0 0 0 0 1 13 0\n"
    "EDGE_SE3:QUAT 0 1 1.1 0 0 0 0 0 1\nEDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1\n"
    "EDGE_SE3:QUAT 2 3 1 0 0 0 0 0 1\nEDGE_SE3:QUAT 0 3 3 0 0 0 0 0 1\n";
constexpr const char* truth =
    "10 0 0 0 0 0 0 1\n11 1.05 0 0 0 0 0 1\n12 2 0 0 0 0 0 1\n13 3 0 0 0 0 0 1\n";

// Missions without payloads and a pipeline that only optimises: cells that take milliseconds.
class Matrix : public ::testing::Test {
 protected:
  Matrix() {
    for (const char* name : {"a", "b"}) {
      fs::create_directories(folder / name);
      write_file(folder / name / "slam_pose_graph.g2o", graph);
      write_file(folder / name / "ground_truth.tum", truth);
    }
    fs::create_directories(folder / "broken");
    write_file(folder / "broken/slam_pose_graph.g2o", "VERTEX_SE3:QUAT 0 nan 0 0 0 0 0 1\n");
    write_file(folder / "p.yaml", "version: 1\nsteps: [{optimize: ceres}, {evaluate: ate}]\n");
  }

  Outcome run(const std::string& command, const std::string& body,
              std::vector<std::string> more = {}) {
    write_file(folder / "m.yaml", "version: 1\npipeline: p.yaml\n" + body);
    std::vector<std::string> arguments = {command,         (folder / "m.yaml").string(),
                                          "--out",         (folder / "out").string(),
                                          "--cache",       (folder / "cache").string(),
                                          "--plugin-path", built("tests/matrix/plugins").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_cambium(arguments);
  }
  nlohmann::json results() { return read_json(folder / "out/results.json"); }

  TemporaryFolder folder;
};

const std::string datasets = "datasets: [{name: a, missions: [a]}, {name: b, missions: [b]}]\n";
const std::string losses =
    "axes: {optimize: [ceres, {plugin: ceres, name: huber, params: {loss: huber}}]}\n";

}  // namespace

TEST_F(Matrix, RunsEveryCombinationAndWritesEveryForm) {
  const auto outcome = run("matrix", datasets + losses + "metrics: [ate.rmse, time.work]\n");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(results()["cells"].size(), 4u);
  EXPECT_EQ(results()["cells"][1]["name"], "huber@a");
  EXPECT_CONTAINS(outcome.out, "4 of 4 cells ran");
  EXPECT_CONTAINS(read_file(folder / "out/results.md"), "| ceres@a | ok | **");
  EXPECT_CONTAINS(read_file(folder / "out/junit.xml"),
                  "<testsuite name=\"a\" tests=\"2\" failures=\"0\" errors=\"0\"");
  const std::string page = read_file(folder / "out/index.html");
  EXPECT_CONTAINS(page, "<svg");
  EXPECT_CONTAINS(page, "ate.rmse [m] against time.work [s]");
  EXPECT_EQ(page.find("http"), std::string::npos) << "the page must not need anything else";
}

TEST_F(Matrix, ACellIsAPlainRunThatCanBeRepeatedByHand) {
  ASSERT_EQ(run("matrix", datasets + losses).code, 0);
  const auto again = run_cambium({"run", (folder / "out/cells/huber@a.yaml").string(), "--out",
                                  (folder / "again").string(), "--cache", "none"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_file(folder / "again/fused.g2o"),
            read_file(folder / "out/cells/huber@a/fused.g2o"));
}

TEST_F(Matrix, CrashesAndHangsAreReportedAndTheRestGoesOn) {
  const auto outcome = run("matrix",
                           "datasets: [{name: a, missions: [a]}]\ntime_limit: 8\n"
                           "axes: {optimize: [crash, hang, ceres]}\n");
  EXPECT_EQ(outcome.code, 1);
  const auto cells = results()["cells"];
  EXPECT_EQ(cells[0]["status"], "crashed");
  EXPECT_CONTAINS(cells[0]["runs"][0]["message"].get<std::string>(), "signal 11");
  EXPECT_EQ(cells[1]["status"], "timed out");
  EXPECT_EQ(cells[2]["status"], "ok");
  EXPECT_CONTAINS(read_file(folder / "out/junit.xml"), "<error type=\"failure\"");
  EXPECT_CONTAINS(outcome.err, "2 failures");
}

TEST_F(Matrix, ARegressionIsFoundAfterAllCellsRan) {
  const std::string body = datasets + losses + "baseline: baseline.json\n";
  const auto absent = run("matrix", body);
  EXPECT_EQ(absent.code, 2);
  EXPECT_CONTAINS(absent.err, "--update-baseline");
  ASSERT_EQ(run("matrix", body, {"--update-baseline"}).code, 0);
  EXPECT_EQ(run("matrix", body).code, 0);

  auto baseline = read_json(folder / "baseline.json");
  baseline["cells"]["ceres@a"]["ate.rmse"] =
      baseline["cells"]["ceres@a"]["ate.rmse"].get<double>() / 2;
  write_file(folder / "baseline.json", baseline.dump());
  const auto worse = run("matrix", body);
  EXPECT_EQ(worse.code, 1);
  EXPECT_CONTAINS(worse.out, "regression   ceres@a ate.rmse");
  EXPECT_EQ(results()["cells"].size(), 4u);
  EXPECT_EQ(run("matrix", body + "tolerances: {\"*\": {relative: 2}}\n").code, 0);
}

TEST_F(Matrix, AMissedExpectationFailsTheCheck) {
  const auto outcome =
      run("matrix",
          datasets + "expect: [{metric: ate.rmse, at_most: 0.000001, where: {dataset: b}}]\n");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_CONTAINS(outcome.out, "expectation  b ate.rmse: expected at most 1e-06, found");
  EXPECT_EQ(results()["findings"].size(), 1u);
}

TEST_F(Matrix, RepeatedRunsHaveTheirOwnSeedsAndCompare) {
  ASSERT_EQ(run("matrix", datasets, {"--repeat", "4"}).code, 0);
  const auto runs = results()["cells"][0]["runs"];
  ASSERT_EQ(runs.size(), 4u);
  EXPECT_EQ(runs[3]["seed"], 4);
  const auto compared =
      run_cambium({"compare", (folder / "out").string(), (folder / "out/results.json").string()});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_CONTAINS(compared.out, "0 metrics moved");
}

TEST_F(Matrix, ShardsLeaveEveryCellInTheCacheOfTheMatrix) {
  const std::string body = datasets + losses;
  const auto first = run("matrix", body, {"--shard", "1/2"});
  EXPECT_CONTAINS(first.out, "shard 1/2: 2 of 2 cells ran");
  EXPECT_FALSE(fs::exists(folder / "out/results.json")) << "a shard judges nothing";
  EXPECT_CONTAINS(run("matrix", body, {"--shard", "2/2"}).out, "shard 2/2: 2 of 2 cells ran");
  fs::remove_all(folder / "out");
  ASSERT_EQ(run("matrix", body).code, 0);
  ASSERT_EQ(results()["cells"].size(), 4u);
  for (const auto& cell : fs::directory_iterator(folder / "out/cells")) {
    if (!cell.is_directory()) continue;
    const auto steps = read_json(cell.path() / "report.json")["steps"];
    EXPECT_TRUE(steps[0]["cached"].get<bool>()) << cell.path() << " was computed again";
  }
  const auto wrong = run("matrix", body, {"--shard", "3/2"});
  EXPECT_EQ(wrong.code, 2);
}

TEST_F(Matrix, MistakesAreReportedAtOnceWithTheirPlaces) {
  const auto outcome = run("matrix",
                           "datasts: []\ndatasets:\n  - {name: a, missions: [a], optinal: true}\n"
                           "axes:\n  optimise: [ceres]\n  optimize[3]: [ceres]\n"
                           "exclude: [{optimize: ceres}]\nexpect: [{metric: x}]\n");
  EXPECT_EQ(outcome.code, 2);
  for (const char* part : {"m.yaml:3:1: unknown key 'datasts'", "did you mean 'optional'?",
                           "m.yaml:7:3: an axis must be a verb", "did you mean 'optimize'?",
                           "has 1 step(s) 'optimize'", "unknown axis 'optimize'",
                           "needs 'at_least', 'at_most' or both"})
    EXPECT_CONTAINS(outcome.err, part);
  const auto plugins = run("matrix", datasets +
                                         "axes: {optimize: [cerez, {plugin: ceres, name: x, "
                                         "params: {lss: huber}}]}\n");
  EXPECT_EQ(plugins.code, 2);
  EXPECT_CONTAINS(plugins.err, "m.yaml:4:19: unknown solver 'cerez'; did you mean 'ceres'?");
  EXPECT_CONTAINS(plugins.err, "unknown parameter 'lss'; did you mean 'loss'?");
}

TEST_F(Matrix, RefusesAFolderThatHoldsSomethingElse) {
  fs::create_directories(folder / "out");
  write_file(folder / "out/photo.jpg", "x");
  const auto outcome = run("matrix", datasets);
  EXPECT_EQ(outcome.code, 2);
  EXPECT_CONTAINS(outcome.err, "not a matrix or batch");
}

TEST_F(Matrix, ABatchGoesOnAfterABrokenDataset) {
  const auto outcome = run("batch",
                           "datasets: [{name: broken, missions: [broken]}, {name: b, "
                           "missions: [b]}, {name: c, missions: [c], optional: true}]\n");
  EXPECT_EQ(outcome.code, 1);
  const auto cells = results()["cells"];
  EXPECT_EQ(cells[0]["status"], "failed");
  EXPECT_CONTAINS(cells[0]["runs"][0]["message"].get<std::string>(), "slam_pose_graph.g2o:1");
  EXPECT_EQ(cells[1]["status"], "ok");
  EXPECT_EQ(cells[2]["status"], "absent");
  EXPECT_TRUE(fs::exists(folder / "out/cells/b/fused.g2o"));
  EXPECT_CONTAINS(outcome.out, "1 of 3 cells ran; 1 failure");
  EXPECT_EQ(run("batch", datasets + losses).code, 2);  // a batch has no axes
}

TEST(ShippedMatrices, AreOfTheCommittedSchema) {
  EXPECT_EQ(run_cambium({"matrix", "--schema"}).out,
            read_file(source("schemas/matrix.schema.json")))
      << "run: ./bootstrap generate";
}

TEST(ShippedMatrices, TheSmallOneIsAsGoodAsItsBaseline) {
  const TemporaryFolder folder;
  const auto outcome =
      run_cambium({"matrix", pipeline("matrix/small.yaml"), "--out", (folder / "out").string(),
                   "--cache", (folder / "cache").string()});
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  // The second cell begins like the first, so it takes everything up to its own step from the
  // cache.
  const auto second = read_json(folder / "out/cells/gicp+huber@small/report.json");
  for (const auto& step : second["steps"])
    if (step["verb"] == "recognize" || step["verb"] == "register")
      EXPECT_TRUE(step["cached"].get<bool>()) << step.dump(1);
}
