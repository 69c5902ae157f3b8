// SPDX-License-Identifier: BSD-3-Clause
// What a user meets at the command line: help, mistakes, exit codes, Ctrl-C.
#include "cambium/files.hpp"
#include "command.hpp"
#include "support/places.hpp"
#include "support/support.hpp"

using namespace cambium;
using namespace cambium::testing;
namespace fs = std::filesystem;

namespace {

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

// A mission of three nodes without payloads.
std::string small_mission(const TemporaryFolder& folder, const std::string& name) {
  const fs::path path = folder / (name + ".g2o");
  write_file(path,
             "VERTEX_SE3:QUAT_TIME 0 0 0 0 0 0 0 1 10 0\n"
             "VERTEX_SE3:QUAT_TIME 1 1 0 0 0 0 0 1 11 0\n"
             "VERTEX_SE3:QUAT_TIME 2 2 0 0 0 0 0 1 12 0\n"
             "EDGE_SE3:QUAT 0 1 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n"
             "EDGE_SE3:QUAT 1 2 1 0 0 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n");
  return path.string();
}

std::string write_pipeline(const TemporaryFolder& folder, const std::string& text) {
  write_file(folder / "p.yaml", text);
  return (folder / "p.yaml").string();
}

}  // namespace

TEST(CommandLine, EveryCommandHelpsWithAnExample) {
  for (const char* command : {"run", "validate", "inspect", "evaluate", "plugins", "schema",
                              "simulate", "cache", "matrix", "batch", "compare", "split",
                              "poses", "report", "query", "changes", "view"}) {
    const auto help = run_cambium({command, "--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_CONTAINS(help.out, "Example: cambium " + std::string(command));
  }
  EXPECT_CONTAINS(run_cambium({"--version"}).out, "cambium 0.");
  EXPECT_EQ(run_cambium({"rum"}).code, 2);
}

TEST(CommandLine, ShippedPipelinesAreValid) {
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(pipeline(""))) {
    // Specifications of missions and matrices have no steps.
    if (entry.path().extension() != ".yaml" ||
        read_file(entry.path()).find("\nsteps:") == std::string::npos)
      continue;
    const auto outcome = run_cambium({"validate", entry.path().string()});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    ++count;
  }
  EXPECT_GE(count, 2);
}

TEST(CommandLine, GeneratedFilesAreThoseOfThePlugins) {
  for (const char* adapter : {"gtsam_solver.so", "g2o_solver.so"})
    if (fs::exists(plugin_folder() / adapter))
      GTEST_SKIP() << adapter << " was built; the generated files are those of a build without it";
  if (!fs::exists(plugin_folder() / "web_view.so"))
    GTEST_SKIP() << "web_view was not built; the generated files are those of a build with it";
  const char* hint = "run: ./bootstrap generate";
  EXPECT_EQ(run_cambium({"schema"}).out, read_file(source("schemas/pipeline.schema.json"))) << hint;
  EXPECT_EQ(run_cambium({"plugins", "describe"}).out, read_file(source("docs/reference.md"))) << hint;
}

TEST(CommandLine, ResolvedPipelineIsAPipeline) {
  const TemporaryFolder folder;
  const auto resolved =
      run_cambium({"validate", pipeline("fuse_scans.yaml"), "--resolved"});
  ASSERT_EQ(resolved.code, 0) << resolved.err;
  const auto again =
      run_cambium({"validate", write_pipeline(folder, resolved.out), "--resolved"});
  EXPECT_EQ(resolved.out, again.out) << again.err;
}

TEST(CommandLine, DescribesPlugins) {
  const auto list = run_cambium({"plugins", "list"});
  EXPECT_EQ(list.code, 0);
  EXPECT_CONTAINS(list.out, "scan_context");
  EXPECT_CONTAINS(run_cambium({"plugins", "describe", "scan_context"}).out,
                  "| `rings` |");
  const auto typo = run_cambium({"plugins", "describe", "scan_contxt"});
  EXPECT_EQ(typo.code, 2);
  EXPECT_CONTAINS(typo.err, "did you mean 'scan_context'?");
}

TEST(CommandLine, MistakesHaveTheirExitCode) {
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  const std::string mission = small_mission(folder, "m");
  const std::string good = write_pipeline(folder, "version: 1\nsteps: [{optimize: ceres}]\n");
  EXPECT_EQ(run_cambium({"run", good, mission, "--out", out}).code, 0);

  const auto unknown =
      run_cambium({"run", good, mission, "--out", out, "--set", "optimize.lss=1"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_CONTAINS(unknown.err, "unknown parameter 'lss'; did you mean 'loss'?");

  const auto absent =
      run_cambium({"run", good, (folder / "nobody").string(), "--out", out});
  EXPECT_EQ(absent.code, 2);
  EXPECT_CONTAINS(absent.err, "no mission at");

  write_file(folder / "bad.g2o",
             "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 nan 0 0 0 0 0 1\n");
  const auto garbage =
      run_cambium({"run", good, (folder / "bad.g2o").string(), "--out", out});
  EXPECT_EQ(garbage.code, 4);
  EXPECT_CONTAINS(garbage.err, "bad.g2o:2");

  const auto refused =
      run_cambium({"run", good, mission, "--out", folder.path().string()});
  EXPECT_EQ(refused.code, 2);
  EXPECT_CONTAINS(refused.err, "not a run of Cambium");
}

TEST(CommandLine, JsonLogIsJson) {
  const TemporaryFolder folder;
  const auto outcome = run_cambium(
      {"run", write_pipeline(folder, "version: 1\nsteps: [{optimize: ceres}]\n"),
       small_mission(folder, "m"), "--out", (folder / "out").string(), "--log-json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  std::istringstream lines(outcome.err);
  int count = 0;
  for (std::string line; std::getline(lines, line); ++count)
    EXPECT_TRUE(nlohmann::json::accept(line)) << line;
  EXPECT_GE(count, 2);
}
