// SPDX-License-Identifier: BSD-3-Clause
#include "pipeline/pipeline.hpp"

#include "cambium/files.hpp"
#include "engine/wiring.hpp"
#include "support/support.hpp"

using namespace cambium;

namespace {

class PipelineFile : public ::testing::Test {
 protected:
  cambium::testing::TemporaryFolder folder;

  Pipeline load(const std::string& text, const std::vector<std::string>& set = {}) {
    write_file(folder / "p.yaml", text);
    return load_pipeline(folder / "p.yaml", set);
  }
  std::string mistakes(const std::string& text, const std::vector<std::string>& set = {}) {
    try {
      const Pipeline p = load(text, set);
      Diagnostics diagnostics;
      check_wiring(p, diagnostics);
      diagnostics.throw_if_any();
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::config);
      return e.what();
    }
    return "";
  }
};

#define EXPECT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

}  // namespace

TEST_F(PipelineFile, ReadsEverything) {
  const Pipeline p = load(R"(version: 1
seed: 7
missions: [a, /abs/b, {path: c, name: third, reader: mission_folder, params: {x: 1}}]
steps:
  - recognize: scan_context
    pairs: between_missions
    min_path: 12.5
    params: {rings: 20}
  - register: gicp
  - verify: pcm
  - optimize: ceres
platforms:
  2: {register: {params: {max_distance: 2.0}}}
)");
  EXPECT_EQ(p.seed, 7u);
  ASSERT_EQ(p.missions.size(), 3u);
  EXPECT_EQ(p.missions[0].path, (folder.path() / "a").string());  // relative to the file
  EXPECT_EQ(p.missions[1].path, "/abs/b");
  EXPECT_EQ(p.missions[2].name, "third");
  ASSERT_EQ(p.steps.size(), 4u);
  EXPECT_EQ(p.steps[0].keys.pairs, "between_missions");
  EXPECT_EQ(p.steps[0].keys.min_path, 12.5);
  EXPECT_EQ(p.steps[0].params.find("rings")->as_int(), 20);
  EXPECT_EQ(p.steps[1].platform_params.at(2).find("max_distance")->as_double(), 2.0);
}

TEST_F(PipelineFile, IsFoundByItsBareNameInTheCurrentFolder) {
  load("version: 1\nmissions: [a]\nsteps: [{recognize: scan_context}]\n");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  std::string mission;
  EXPECT_NO_THROW(mission = load_pipeline("p.yaml", {}).missions.at(0).path);
  std::filesystem::current_path(before);
  EXPECT_EQ(mission, (std::filesystem::canonical(folder.path()) / "a").string());
}

TEST_F(PipelineFile, NamesEveryMistakeWithItsPlace) {
  const std::string text = mistakes(R"(version: 2
missons: [a]
steps:
  - optimise: ceres
  - recognize: sc
    pair: all
  - recognize: sc
    pairs: betwen_missions
  - [1]
)");
  EXPECT_CONTAINS(text, "p.yaml:1:10: 'version' must be 1, found '2'");
  EXPECT_CONTAINS(text,
                  "p.yaml:2:1: unknown key 'missons' in the pipeline; did you mean 'missions'?");
  EXPECT_CONTAINS(text, "p.yaml:4:5: a step must open with a verb");
  EXPECT_CONTAINS(text, "did you mean 'optimize'?");
  EXPECT_CONTAINS(text, "p.yaml:6:5: unknown parameter 'pair'; did you mean 'pairs'?");
  EXPECT_CONTAINS(text, "'pairs' cannot be 'betwen_missions'; did you mean 'between_missions'?");
  EXPECT_CONTAINS(text, "p.yaml:9:5");
}

TEST_F(PipelineFile, RefusesBrokenYaml) {
  EXPECT_CONTAINS(mistakes("version: [1\n"), "p.yaml:");
  EXPECT_CONTAINS(mistakes("version: 1\nversion: 1\nsteps: []\n"), "duplicate key 'version'");
  EXPECT_CONTAINS(mistakes("just a text"), "expected a map");
  EXPECT_CONTAINS(mistakes(""), "expected a map");
  EXPECT_CONTAINS(mistakes("version: 1\n"), "'steps' is missing");
}

TEST_F(PipelineFile, WiringIsCheckedBeforeAnythingRuns) {
  const std::string head = "version: 1\nsteps:\n";
  EXPECT_CONTAINS(mistakes(head + "  - register: gicp\n"), "'register' has no candidates");
  EXPECT_CONTAINS(mistakes(head + "  - recognize: sc\n  - register: gicp\n    loops: accepted\n"),
                  "no accepted loops to work on");
  EXPECT_CONTAINS(mistakes(head + "  - recognize: sc\n  - verify: pcm\n"),
                  "'verify' has no registered loops");
  EXPECT_CONTAINS(mistakes(head + "  - recognize: sc\n  - register: g\n  - optimize: c\n"),
                  "no 'verify' step has judged");
  EXPECT_CONTAINS(mistakes(head + "  - recognize: sc\n    payload: coarse\n"),
                  "no earlier filter writes the payload stream 'coarse'");
  EXPECT_CONTAINS(mistakes(head + "  - export: cloud\n  - export: cloud\n"), "give one of them");
  EXPECT_EQ(
      mistakes(head + "  - filter: v\n    as: coarse\n  - recognize: sc\n    payload: coarse\n"
                      "  - register: g\n  - verify: p\n  - optimize: c\n"),
      "");
}

TEST_F(PipelineFile, OverridesReachTheNamedSteps) {
  const std::string text = "version: 1\nsteps:\n  - optimize: a\n  - optimize: b\n";
  const Pipeline all = load(text, {"optimize.loss=huber"});
  EXPECT_EQ(all.steps[0].params.find("loss")->scalar, "huber");
  EXPECT_EQ(all.steps[1].params.find("loss")->scalar, "huber");
  const Pipeline one = load(text, {"optimize[2].loss=huber"});
  EXPECT_EQ(one.steps[0].params.find("loss"), nullptr);
  EXPECT_EQ(one.steps[1].params.find("loss")->scalar, "huber");
  EXPECT_CONTAINS(mistakes(text, {"optimise.loss=huber"}), "did you mean 'optimize'?");
  EXPECT_CONTAINS(mistakes(text, {"optimize[3].loss=huber"}), "nothing to set");
  EXPECT_CONTAINS(mistakes(text, {"loss"}), "found no '='");
  EXPECT_CONTAINS(mistakes(text, {"loss=1"}), "--set loss=1: 'loss' is not of the form");
}

TEST_F(PipelineFile, ExtendsReplacesListsAndMergesTheRest) {
  write_file(folder / "base.yaml",
             "version: 1\nseed: 3\nmissions: [m]\nsteps: [{optimize: a}]\n"
             "set: {optimize.x: 1, optimize.y: 2}\n");
  const Pipeline p = load("version: 1\nextends: base.yaml\nset: {optimize.x: 5}\n");
  EXPECT_EQ(p.seed, 3u);
  ASSERT_EQ(p.steps.size(), 1u);
  EXPECT_EQ(p.steps[0].params.find("x")->as_int(), 5);
  EXPECT_EQ(p.steps[0].params.find("y")->as_int(), 2);
  EXPECT_CONTAINS(mistakes("version: 1\nextends: p.yaml\n"), "extends itself");
  EXPECT_THROW(load("version: 1\nextends: absent.yaml\n"), Error);
}

TEST_F(PipelineFile, MistakesOfABaseNameTheBase) {
  write_file(folder / "base.yaml", "version: 1\nsteps: [{optimise: a}]\n");
  EXPECT_CONTAINS(mistakes("version: 1\nextends: base.yaml\n"), "base.yaml:2:9");
}

TEST_F(PipelineFile, PlatformsOverrideOnlyWhatCanDiffer) {
  const std::string text = "version: 1\nsteps: [{optimize: a}]\nplatforms:\n";
  EXPECT_CONTAINS(mistakes(text + "  2: {optimize: {params: {x: 1}}}\n"), "cannot differ");
  EXPECT_CONTAINS(mistakes(text + "  two: {filter: {params: {x: 1}}}\n"), "PLATFORM_ID");
  EXPECT_CONTAINS(mistakes(text + "  2: {filter: {params: {x: 1}}}\n"), "no step 'filter'");
}
