// SPDX-License-Identifier: BSD-3-Clause
// Whole runs with small made-up components: order, resuming, islands, broken plugins.
#include <fstream>

#include "cambium/files.hpp"
#include "engine/run.hpp"
#include "support/support.hpp"
#include "support/trusting.hpp"

using namespace cambium;
namespace fs = std::filesystem;

namespace {

// A mission file holds one word; its nodes stand on a line, in a frame that the word decides.
SE3 frame_of(const std::string& word) { return SE3::from_yaw(double(word.size()), {1, 2, 3}); }

struct WordReader final : MissionReader {
  bool accepts(const fs::path&) const override { return true; }
  Mission read(const fs::path& path, const Context&) const override {
    std::vector<SE3> poses;
    for (int i = 0; i < 6; ++i)
      poses.push_back(frame_of(read_file(path)) * SE3::from_yaw(0, {5.0 * i, 0, 0}));
    Mission m = cambium::testing::make_mission(path.stem().string(), poses);
    for (Node& node : m.nodes) node.stamp->sec += 1000 * m.name[0];  // each at its own time
    m.digest = digest_file(path);
    return m;
  }
};

std::atomic<int> describe_calls{0};

// Knows that equal node numbers are the same place, unless a mission's name begins with "far".
struct SameNumber final : PlaceRecognizer {
  double margin = 1;
  void params(ParamVisitor& v) override { v("margin", margin, "Of no use", above(0)); }
  Fingerprints describe(const MissionView& m, const Context&) const override {
    ++describe_calls;
    const std::string& name = m.mission().name;
    return {1, 2, {name.starts_with("far") ? 0.f : 1.f, float(name.size())}, {}};
  }
  std::vector<Candidate> match(const Fingerprints& q, const Fingerprints& r, const Pairing& pairing,
                               const Context&) const override {
    std::vector<Candidate> out;
    if (pairing.within_mission || q.table[0] == 0 || r.table[0] == 0) return out;
    for (std::size_t i = 0; i < 6; ++i) out.push_back({i, i, 1.0, SE3{}});
    return out;
  }
};

struct NeverSure final : Registration {
  Alignment align(const Prepared&, const Prepared&, const SE3&, const Context&) const override {
    Alignment a;
    a.reason = "never sure";
    return a;
  }
};

struct StandStill : Solver {
  Solution solve(const PoseGraph& g, const Context&) const override {
    Solution s;
    s.T_map_node = g.T_map_node;
    s.weight.assign(g.relative.size(), 1.0);
    s.converged = true;
    s.marginals.assign(g.marginals.size(), Mat6(0.25 * Mat6::Identity()));
    return s;
  }
};

// Puts the first mission of two 0.3 m higher.
struct Lifts final : StandStill {
  Solution solve(const PoseGraph& g, const Context& context) const override {
    Solution s = StandStill::solve(g, context);
    for (std::size_t i = 0; i < s.T_map_node.size() / 2; ++i) s.T_map_node[i].t.z() += 0.3;
    return s;
  }
};

struct NotANumber final : StandStill {
  Solution solve(const PoseGraph& g, const Context& context) const override {
    Solution s = StandStill::solve(g, context);
    s.T_map_node[0].t.x() = std::nan("");
    return s;
  }
};

class EngineRun : public ::testing::Test {
 protected:
  EngineRun() {
    registry.add<WordReader>("word", "");
    registry.add<SameNumber>("same_number", "");
    registry.add<cambium::testing::TrustGuess>("trust", "");
    registry.add<NeverSure>("never_sure", "");
    registry.add<Lifts>("lifts", "");
    registry.add<cambium::testing::AcceptAll>("accept", "");
    registry.add<StandStill>("still", "");
    registry.add<NotANumber>("nan", "");
    write_file(folder / "p.yaml",
               "version: 1\nsteps: [{recognize: same_number}, {register: trust}, "
               "{verify: accept}, {optimize: still}]\n");
  }

  std::string mission(const std::string& name) {
    write_file(folder / (name + ".txt"), name);
    return (folder / (name + ".txt")).string();
  }

  RunResult run(std::vector<std::string> missions, const std::string& out, int threads = 1,
                std::vector<std::string> set = {}) {
    RunOptions options;
    options.pipeline = folder / "p.yaml";
    options.missions = std::move(missions);
    options.overrides = std::move(set);
    options.out = folder / out;
    options.explain = true;
    Progress progress(Progress::Style::quiet, LogLevel::error);
    EngineOptions engine_options;
    engine_options.threads = threads;
    engine_options.cache = folder / "cache";
    const Engine engine(engine_options, progress);
    return run_pipeline(options, prepare_run(options, registry), registry, engine);
  }

  cambium::testing::TemporaryFolder folder;
  Registry registry;
};

}  // namespace

TEST_F(EngineRun, FusesMissionsFromDifferentFrames) {
  const auto r = run({mission("a"), mission("bb")}, "out");
  ASSERT_EQ(r.known.atlas.islands.size(), 1u);
  for (std::uint32_t i = 0; i < 6; ++i)
    EXPECT_LT((r.known.atlas.T_map_node({0, i}).t - r.known.atlas.T_map_node({1, i}).t).norm(),
              1e-9);
  ASSERT_EQ(r.known.atlas.stages.size(), 1u);
  EXPECT_EQ(r.known.atlas.stages[0].step, "still");
  EXPECT_EQ(r.known.atlas.stages[0].T_map_node[1], r.known.atlas.missions[1].T_map_node);
  for (const char* name : {"fused.g2o", "a.tum", "bb.tum", "resolved.yaml", "report.json",
                           "report.html", "ledger.jsonl"})
    EXPECT_TRUE(fs::exists(folder / "out" / name)) << name;
}

TEST_F(EngineRun, BytesDoNotDependOnOrderOrThreads) {
  const std::vector<std::string> m = {mission("a"), mission("bb"), mission("ccc"), mission("far")};
  run({m[0], m[1], m[2], m[3]}, "one", 1);
  fs::remove_all(folder / "cache");
  run({m[2], m[3], m[1], m[0]}, "two", 4);
  for (const char* name : {"fused.g2o", "fused_island_1.g2o", "ccc.tum", "ledger.jsonl"})
    EXPECT_EQ(read_file(folder / "one" / name), read_file(folder / "two" / name)) << name;
}

TEST_F(EngineRun, AFinishedRunGrowsByNewPairsOnly) {
  const std::string a = mission("a"), b = mission("bb"), c = mission("ccc");
  run({a, b}, "ab");
  const auto grown = run({(folder / "ab").string(), c}, "grown");
  // Known are two descriptions and the pairs a-a, bb-bb and a-bb, of three and six.
  EXPECT_EQ(grown.steps[0].items, 9u);
  EXPECT_EQ(grown.steps[0].cached, 5u);
  fs::remove_all(folder / "cache");
  run({a, b, c}, "abc");
  for (const char* name : {"fused.g2o", "a.tum", "bb.tum", "ccc.tum", "ledger.jsonl"})
    EXPECT_EQ(read_file(folder / "grown" / name), read_file(folder / "abc" / name)) << name;
  // Runs may overlap; the missions that both have stay once.
  run({b, c}, "bc");
  const auto both = run({(folder / "ab").string(), (folder / "bc").string()}, "both");
  EXPECT_EQ(both.known.atlas.missions.size(), 3u);
}

TEST_F(EngineRun, ACopyOfAMissionIsRefused) {
  const std::string a = mission("a");
  fs::copy(a, folder / "aa.txt");
  try {
    run({a, (folder / "aa.txt").string()}, "out");
    FAIL() << "expected a refusal";
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::data);
    EXPECT_NE(std::string(e.what()).find("'a' and 'aa' are the same recording"), std::string::npos)
        << e.what();
  }
}

TEST_F(EngineRun, MissionsThatNeverMeetAreIslands) {
  const auto r = run({mission("a"), mission("far")}, "out");
  EXPECT_EQ(r.known.atlas.islands.size(), 2u);
  EXPECT_TRUE(fs::exists(folder / "out" / "fused_island_1.g2o"));
  EXPECT_NE(r.report["warnings"].dump().find("2 islands"), std::string::npos);
}

TEST_F(EngineRun, RunningAgainIsTakenFromTheCache) {
  const std::vector<std::string> m = {mission("a"), mission("bb")};
  run(m, "out");
  describe_calls = 0;
  const auto again = run(m, "out");
  EXPECT_EQ(describe_calls, 0);
  for (const auto& step : again.steps) EXPECT_EQ(step.items, step.cached) << step.verb;
  const auto changed = run(m, "out", 1, {"recognize.margin=2"});
  EXPECT_EQ(describe_calls, 2);  // only what depends on the parameter
  EXPECT_EQ(changed.steps[1].cached, changed.steps[1].items);
  run({m[0], m[1], mission("ccc")}, "more");
  EXPECT_EQ(describe_calls, 3);  // only the new mission
}

TEST_F(EngineRun, SaysWhichPartOfTheKeyChanged) {
  const std::vector<std::string> m = {mission("a"), mission("bb")};
  run(m, "out");
  ::testing::internal::CaptureStderr();
  RunOptions options;
  options.pipeline = folder / "p.yaml";
  options.missions = m;
  options.out = folder / "out";
  options.overrides = {"recognize.margin=3"};
  options.explain = true;
  Progress progress(Progress::Style::lines);
  EngineOptions engine_options;
  engine_options.cache = folder / "cache";
  const Engine engine(engine_options, progress);
  run_pipeline(options, prepare_run(options, registry), registry, engine);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("recognize same_number: changed: margin: 1.0 -> 3.0"), std::string::npos)
      << text;
  EXPECT_NE(text.find("optimize still: nothing changed, taken from the cache"), std::string::npos)
      << text;
}

TEST_F(EngineRun, ReportsTheSigmasOfChosenNodes) {
  write_file(folder / "p.yaml", "version: 1\nsteps: [{optimize: still, marginals: [bb/2]}]\n");
  const auto r = run({mission("a"), mission("bb")}, "out");
  const auto& figures = r.steps.at(0).figures;
  const auto at = std::find_if(figures.begin(), figures.end(),
                               [](const Score& f) { return f.first == "bb/2.sigma_yaw"; });
  ASSERT_NE(at, figures.end());
  EXPECT_EQ(at->second, 0.5);

  for (const auto& [name, complaint] : {std::pair{"bbb/2", "did you mean 'bb'?"},
                                        {"a/77", "found no node 77 in 'a'"},
                                        {"a", "expected MISSION/ID"}}) {
    write_file(folder / "p.yaml",
               std::string("version: 1\nsteps: [{optimize: still, marginals: [") + name + "]}]\n");
    try {
      run({mission("a"), mission("bb")}, "bad");
      FAIL() << name;
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), ErrorCode::config);
      EXPECT_NE(std::string(e.what()).find(complaint), std::string::npos) << e.what();
    }
  }
}

TEST_F(EngineRun, AcceptedLoopsAreRegisteredAgainFromTheMap) {
  const std::string first =
      "version: 1\nsteps: [{recognize: same_number}, {register: trust}, {verify: accept}, "
      "{optimize: lifts}, ";
  write_file(folder / "p.yaml", first + "{register: trust, loops: accepted}]\n");
  const auto trusted = run({mission("a"), mission("bb")}, "trusted").known.atlas;
  ASSERT_EQ(trusted.loops.size(), 6u);
  for (const Loop& loop : trusted.loops) {
    const SE3 T_map = trusted.T_map_node(loop.tail).inverse() * trusted.T_map_node(loop.head);
    EXPECT_EQ(loop.state, LoopState::accepted);
    EXPECT_NEAR(T_map.t.z(), -0.3, 1e-9) << "the recogniser's guess is 0";
    EXPECT_LT((loop.T_tail_head.t - T_map.t).norm(), 0.02);
  }
  write_file(folder / "p.yaml", first + "{register: never_sure, loops: accepted}]\n");
  for (const Loop& loop : run({mission("a"), mission("bb")}, "unsure").known.atlas.loops) {
    EXPECT_EQ(loop.state, LoopState::rejected);
    EXPECT_EQ(loop.reason, "never sure");
  }
}

TEST_F(EngineRun, TakesAFolderThatARunWasKilledInAtItsFirstFile) {
  fs::create_directories(folder / "killed");
  write_file(folder / "killed/.tmp-999999999-0-resolved.yaml", "versi");
  run({mission("a")}, "killed");
  EXPECT_TRUE(fs::exists(folder / "killed/resolved.yaml"));
  EXPECT_FALSE(fs::exists(folder / "killed/.tmp-999999999-0-resolved.yaml"));
}

TEST_F(EngineRun, RefusesWhatIsNotARunFolder) {
  fs::create_directories(folder / "photos");
  write_file(folder / "photos/dog.jpg", "x");
  try {
    run({mission("a")}, "photos");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::config);
    EXPECT_NE(std::string(e.what()).find("holds something that is not a run"), std::string::npos);
  }
}

TEST_F(EngineRun, NamesTwinsAndAbsentMissions) {
  fs::create_directories(folder / "other");
  write_file(folder / "other/a.txt", "again");
  try {
    run({mission("a"), (folder / "other/a.txt").string()}, "out");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::data);
    EXPECT_NE(std::string(e.what()).find("the mission name 'a' is used twice"), std::string::npos);
  }
  EXPECT_THROW(run({(folder / "nobody").string()}, "out"), Error);
  EXPECT_THROW(run({}, "out"), Error);
}

TEST_F(EngineRun, ABrokenSolverIsNamedAndWritesNoMap) {
  write_file(folder / "p.yaml", "version: 1\nsteps: [{optimize: nan}]\n");
  try {
    run({mission("a")}, "out");
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), ErrorCode::numeric);
    EXPECT_NE(std::string(e.what()).find("optimize nan"), std::string::npos) << e.what();
  }
  EXPECT_FALSE(fs::exists(folder / "out/fused.g2o"));
}
